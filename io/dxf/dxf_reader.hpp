#pragma once

#include <string>
#include <vector>

#include "io/dxf/drawing_choice.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads the lines, polylines, arcs, circles, ellipses and splines of an ASCII DXF file, in model space and
/// within blocks, as exact curves with unchanged coordinates. Only layers that are neither off nor frozen are
/// read, unless they are named; dimensions, texts, hatches, leaders and points are left out. A warning counts
/// what is left out by type and layer. The boundary is named by the layer, or as the choice says. `unit`
/// receives the unit and the layers. Throws InputError with line, layer and handle.
std::vector<Chain> read_dxf(const std::string& path, const DrawingChoice& choice,
                            std::vector<std::string>& warnings, FileUnit& unit);

}  // namespace quadloop::io
