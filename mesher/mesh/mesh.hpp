#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The layers of thin cells that stand on a boundary.
struct WallLayers {
  std::int32_t count = 0;  ///< 0: none
  double thickness = 0;    ///< of all together, normal to the boundary, as it was asked for; 0: not known

  friend bool operator==(const WallLayers&, const WallLayers&) = default;
};

/// The edges of one named boundary on this rank, each walked with the domain to its left.
struct BoundaryEdges {
  std::string name;
  std::string condition;  ///< as Boundary::condition
  std::vector<std::array<NodeId, 2>> edges;
  WallLayers layers = {};
};

using NodeFlags = IdVector<NodeId, char>;  ///< for each node 1 or 0

/// One rank's part of a mesh of triangles and quadrilaterals. Cells are counter-clockwise. Nodes are owned by
/// one rank each and numbered over all ranks in the order of ranks: this rank's owned nodes come first, in
/// global order, then copies of other ranks' nodes that its cells touch. Each cell, and each boundary edge,
/// is on one rank alone, which need not own any of its nodes: of the cells round an owned node some may be
/// other ranks' (HaloMesh has them all). The global order of cells is the order of ranks, then the order
/// here. `boundaries` has the same entries in the same order on every rank (also where this rank has no edge
/// of it).
struct Mesh {
  std::vector<Point> points;    ///< owned nodes, then copies
  std::int64_t first_node = 0;  ///< global number of points[0]
  std::int32_t owned_nodes = 0;
  std::vector<GlobalNodeId> copies;  ///< global numbers of points[owned_nodes ...]
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<std::array<NodeId, 4>> quads;
  std::vector<BoundaryEdges> boundaries;

  bool owns(NodeId node) const { return node.value() < owned_nodes; }
  const Point& point(NodeId node) const { return points[node.value()]; }
  GlobalNodeId global(NodeId node) const {
    return owns(node) ? GlobalNodeId{first_node + node.value()} : copies[node.value() - owned_nodes];
  }
};

/// Numbers of nodes and cells over all ranks.
struct MeshCounts {
  std::int64_t nodes = 0, triangles = 0, quads = 0, boundary_edges = 0;
};

}  // namespace quadloop
