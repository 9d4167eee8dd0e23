#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// An edge of a part, the part to its left.
struct PartSide {
  std::int32_t part = 0;
  std::int32_t neighbour = -1;  ///< the part to its right, where it is no boundary edge
  std::int32_t boundary = -1;   ///< the boundary of the whole mesh that it is of
  std::int64_t place = -1;      ///< and its number among that one's edges over all ranks, from 0
  std::array<GlobalNodeId, 2> nodes = {};
};

/// The rank that holds, and writes, a part. Parts follow each other along a curve, as do ranks.
inline int rank_of_part(const Communicator& comm, std::int32_t part, std::int32_t parts) {
  return static_cast<int>(std::int64_t{part} * comm.size() / parts);
}

/// The boundary edges of this rank's parts, and their edges to other parts, in no particular order. An edge
/// between two blocks that is of a boundary goes to the part with the cell to its left; the other part has it
/// as an edge to that one. *Collective.* Throws InputError where a boundary edge has no cell to its left.
std::vector<PartSide> part_sides(const Communicator& comm, const Mesh& mesh, const CellParts& cells);

}  // namespace quadloop
