#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/grid/size_options.hpp"

namespace quadloop {

/// Line sources with the cell sizes that wakes without layers request, and warnings about wakes that end
/// early.
struct WakeSizes {
  std::vector<SizeSource> sources;
  std::vector<std::string> warnings;
};

/// Returns the sizes along the input's wakes without layers. A wake has the course that place_lines() gives
/// it. It ends before the first boundary that it meets, at a distance along its line of twice the spacing or
/// of the thickness of the boundary's layers, whichever is larger. The spacing varies linearly along the
/// requested length; sources have that of their first point and deviate from the line by at most a quarter of
/// it. Along a wake that follows the flow but knows no streamline, sizes grow by at least a twentieth of the
/// distance. Depends on its arguments only; mirror images of wakes have mirror images of sources. Throws
/// InputError as place_lines() does.
WakeSizes sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured);

/// Returns the input with these sources added to the case's own, if it has wakes without layers. Adds the
/// warnings.
std::optional<MeshInput> with_sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured,
                                             std::vector<std::string>& warnings);
/// The same, without the warnings.
std::optional<MeshInput> with_sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured);

}  // namespace quadloop
