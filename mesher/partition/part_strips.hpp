#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Returns the strips of a part with these nodes (numbers in the whole mesh, ascending): the columns that are
/// complete in the part, each run of two or more as a strip, in the order of the whole mesh. Their nodes have
/// the numbers of the part.
std::vector<StripLayers> strips_in_part(const std::vector<StripLayers>& strips,
                                        std::span<const std::int64_t> nodes);

}  // namespace quadloop
