#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "adapt/metric/tile/tile_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A triangle with all that is known of its nodes, on its way between ranks.
struct LooseTriangle {
  std::array<TileNode, 3> nodes;
  std::array<std::int32_t, 3> boundaries{-1, -1, -1};  ///< of the edge from node k to the next; below 0: none

  Point centroid() const;  ///< the same whichever node is first
};

/// The triangles of a mesh that has no others, each on the rank that has it. `metrics` has one for each owned
/// node and copy. *Collective.*
std::vector<LooseTriangle> loosened(const Communicator& comm, const Mesh& mesh,
                                    const std::vector<LogMetric>& metrics);

/// A mesh of these triangles, in their order over all ranks: nodes are numbered as they come up first, and
/// owned by the rank where they do; boundary edges are where their triangles are. Nodes are told apart by
/// their ids, 0 and more. `boundaries` gives names and conditions; edges of it do not count. *Collective.*
Mesh joined(const Communicator& comm, const std::vector<LooseTriangle>& triangles,
            const std::vector<BoundaryEdges>& boundaries);

}  // namespace quadloop
