#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "adapt/metric/tile/tile_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// A triangle with the data of its nodes, for messages between ranks.
struct LooseTriangle {
  std::array<TileNode, 3> nodes;
  /// Boundary of the edge from node k to the next; negative: none.
  std::array<std::int32_t, 3> boundaries{-1, -1, -1};

  Point centroid() const;  ///< independent of the first node
};

/// The triangles of a pure triangle mesh, each on its rank. `metrics` has one entry per owned node and ghost
/// copy. *Collective.*
std::vector<LooseTriangle> loosened(const Communicator& comm, const Mesh& mesh,
                                    const std::vector<LogMetric>& metrics);

/// Builds a mesh of these triangles in their global order. Nodes are numbered by first occurrence, and owned
/// by the rank of the first occurrence; boundary edges are on the ranks of their triangles. Nodes are
/// identified by their ids, which are not negative. `boundaries` gives names and conditions only.
/// *Collective.*
Mesh joined(const Communicator& comm, const std::vector<LooseTriangle>& triangles,
            const std::vector<BoundaryEdges>& boundaries);

}  // namespace quadloop::adapt
