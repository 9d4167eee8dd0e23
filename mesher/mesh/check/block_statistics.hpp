#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// Size of one block of a mesh.
struct BlockStatistics {
  std::string name;
  std::int64_t cells = 0;
  double area = 0;
};

/// Returns the size of each block of a mesh that is whole on this rank. `names` are those of the blocks.
std::vector<BlockStatistics> block_statistics(const Mesh& mesh, const CellBlocks& blocks,
                                              std::span<const std::string> names);

/// Edges between cells of two blocks.
struct InterfaceEdges {
  std::int64_t all = 0;
  std::int64_t unnamed = 0;  ///< of these, those that belong to no boundary
};

/// `topology` must keep all edges.
InterfaceEdges interface_edges(const Mesh& mesh, const CellBlocks& blocks, const MeshTopology& topology);

}  // namespace quadloop
