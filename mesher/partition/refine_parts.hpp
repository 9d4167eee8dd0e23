#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// What cells weigh, and what a part may.
struct PartWeights {
  std::int64_t of_triangle = 3, of_quad = 4;
  std::int64_t least = 0, most = 0;  ///< of a part
};

/// Moves cells between neighbouring parts so that fewer edges lie between parts. Two neighbours at a time:
/// the cells near the line between them go to one rank (refine_sides); pairs that have no part in common work
/// at the same time. The same on any number of ranks; no rank holds more than the cells near the lines of its
/// parts. Parts begin within the bounds of their weight and stay there. *Collective.*
void refine_parts(const Communicator& comm, const Mesh& mesh, const PartWeights& weights, CellParts& cells);

}  // namespace quadloop
