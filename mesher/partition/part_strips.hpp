#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Of strips of a mesh what a part has that holds these of its nodes (their numbers, ascending): the columns
/// that are whole there, each run of two or more as a strip, in the order of the whole. Their nodes are
/// numbered as in the part.
std::vector<StripLayers> strips_in_part(const std::vector<StripLayers>& strips,
                                        std::span<const std::int64_t> nodes);

}  // namespace quadloop
