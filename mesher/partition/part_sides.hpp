#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// An edge of a part, which is on its left.
struct PartSide {
  std::int32_t part = 0;
  std::int32_t neighbour = -1;  ///< part on its right, if it is not a boundary edge
  std::int32_t boundary = -1;   ///< its boundary in the whole mesh
  std::int64_t place = -1;      ///< number among the edges of that boundary over all ranks, from 0
  std::array<GlobalNodeId, 2> nodes = {};
};

/// Returns the rank that stores, and writes, a part. Parts and ranks are ordered along a curve.
inline int rank_of_part(const Communicator& comm, std::int32_t part, std::int32_t parts) {
  return static_cast<int>(std::int64_t{part} * comm.size() / parts);
}

/// Returns the boundary edges of this rank's parts and their edges to other parts, unordered. An edge between
/// two blocks that is also a boundary edge goes to the part with the cell on its left; the other part has it
/// as an edge to that part. An edge of an inner line goes to the part with the cells on both sides; between
/// two parts it is only an edge between these. Throws InputError if a boundary edge has no cell on its left.
/// *Collective.*
std::vector<PartSide> part_sides(const Communicator& comm, const Mesh& mesh, const CellParts& cells);

}  // namespace quadloop
