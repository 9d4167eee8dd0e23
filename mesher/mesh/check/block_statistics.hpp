#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Size of one block of a mesh.
struct BlockStatistics {
  std::string name;
  std::int64_t cells = 0;
  double area = 0;
};

/// Returns the size of each block; `blocks` has the blocks of this rank's cells, `names` are those of the
/// blocks. Bitwise independent of the number of ranks. *Collective.*
std::vector<BlockStatistics> block_statistics(const Communicator& comm, const Mesh& mesh,
                                              const CellBlocks& blocks, std::span<const std::string> names);

/// Edges between cells of two blocks.
struct InterfaceEdges {
  std::int64_t all = 0;
  std::int64_t unnamed = 0;  ///< of these, those that belong to no boundary
};

/// `between_blocks` is the number of edges between two blocks (EdgeStatistics). *Collective.*
InterfaceEdges interface_edges(const Communicator& comm, const Mesh& mesh, std::int64_t between_blocks);

}  // namespace quadloop
