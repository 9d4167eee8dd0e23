#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Layer cells along a boundary.
struct WallLayers {
  std::int32_t count = 0;  ///< 0: none
  double thickness = 0;    ///< requested total thickness, normal to the boundary; 0: not known

  friend bool operator==(const WallLayers&, const WallLayers&) = default;
};

/// The edges of one named boundary on this rank, each directed with the domain to its left.
struct BoundaryEdges {
  std::string name;
  BoundaryCondition condition = {};
  std::vector<std::array<NodeId, 2>> edges;
  WallLayers layers = {};
  /// Whether its edges lie between two blocks: each is listed once, with the first of the blocks to its left.
  bool between_blocks = false;
  /// Whether it is an inner line: its edges lie inside blocks, and each is listed once, in the direction of
  /// the line.
  bool inner_line = false;

  /// Whether its edges have cells on both sides.
  bool two_sided() const { return between_blocks || inner_line; }
};

/// Layers on both sides of an interior line, e.g. a wake, stored as columns of nodes across the line. The
/// same on every rank.
struct StripLayers {
  std::string name;
  WallLayers layers;  ///< on each side of the line
  /// Whether the line begins at a wall, e.g. at a trailing edge. Its first column then consists of the wall's
  /// two layer columns at that point, one on each side of the line.
  bool from_wall = false;
  /// Nodes per column: 2 * layers.count + 1, plus one for each row of cells between the two sides behind a
  /// blunt trailing edge.
  std::int32_t across = 0;
  /// Nodes column by column along the line; within a column from the right side of the line to its left.
  std::vector<GlobalNodeId> nodes;

  std::int32_t columns() const { return across > 0 ? size32(nodes) / across : 0; }
  GlobalNodeId node(std::int32_t column, std::int32_t row) const {
    return nodes[static_cast<std::size_t>(column) * across + row];
  }
  /// Whether the node belongs to a layer column of the wall.
  bool is_walls(std::int32_t column, std::int32_t row) const {
    return from_wall && column == 0 && (row <= layers.count || row >= across - 1 - layers.count);
  }

  friend bool operator==(const StripLayers&, const StripLayers&) = default;
};

/// A node with a name: at a point that must be one.
struct NamedNode {
  std::string name;
  GlobalNodeId node;

  friend bool operator==(const NamedNode&, const NamedNode&) = default;
};

/// The blocks of a mesh: the block of each of this rank's cells, as index into the names, which are the same
/// on all ranks.
struct MeshBlocks {
  std::vector<std::string> names;
  std::vector<std::int32_t> of_triangles, of_quads;
};

using NodeFlags = IdVector<NodeId, char>;  ///< 1 or 0 for each node

template <class Nodes>
bool any_flagged(const NodeFlags& flags, const Nodes& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId n) { return flags[n] != 0; });
}

/// Calls `visit(node)` for each flagged node, in ascending order; `visit` may change the flag. Fast if few
/// are flagged.
template <class Visit>
void for_each_flagged(const NodeFlags& flags, const Visit& visit) {
  std::int32_t i = 0;
  const auto visit_below = [&](std::int32_t end) {
    for (; i < end; ++i) {
      if (flags.data()[i] != 0) visit(NodeId{i});
    }
  };
  constexpr std::int32_t at_once = sizeof(std::uint64_t);
  for (const std::int32_t size = size32(flags); i < size;) {
    std::uint64_t some = 1;
    if (i + at_once <= size) std::memcpy(&some, flags.data() + i, at_once);
    if (some == 0)
      i += at_once;
    else
      visit_below(std::min(i + at_once, size));
  }
}

template <class Nodes>
void flag_all(const Nodes& nodes, NodeFlags& flags) {
  for (const NodeId node : nodes) flags[node] = 1;
}

/// One rank's part of a mesh of triangles and quadrilaterals. Cells are counter-clockwise. Each node is owned
/// by one rank; global node numbers follow the order of ranks. Owned nodes come first, in global order, then
/// ghost (halo) nodes: nodes of other ranks that this rank's cells touch. Each cell and each boundary edge is
/// stored on exactly one rank. The rank that stores a cell need not own its nodes, so some cells around an
/// owned node may be on other ranks; HaloMesh adds them. Cells are ordered globally by rank, then by local
/// index. `boundaries` has the same entries in the same order on every rank, even if this rank has no edge of
/// them.
struct Mesh {
  std::vector<Point> points;    ///< owned nodes, then ghosts
  std::int64_t first_node = 0;  ///< global number of points[0]
  std::int32_t owned_nodes = 0;
  std::vector<GlobalNodeId> ghosts;  ///< global numbers of the ghosts, points[owned_nodes ...]
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<std::array<NodeId, 4>> quads;
  std::vector<BoundaryEdges> boundaries;
  std::vector<StripLayers> strips;
  std::vector<PeriodicPair> pairs = {};     ///< of boundaries whose nodes match: paired_nodes()
  MeshBlocks blocks = {};                   ///< without names there is one block, and the lists are empty
  std::vector<NamedNode> named_nodes = {};  ///< the same on every rank

  bool owns(NodeId node) const { return node.value() < owned_nodes; }
  const Point& point(NodeId node) const { return points[node.value()]; }
  GlobalNodeId global(NodeId node) const {
    return owns(node) ? GlobalNodeId{first_node + node.value()} : ghosts[node.value() - owned_nodes];
  }
  std::size_t cell_count() const { return triangles.size() + quads.size(); }

  /// Calls `visit(nodes)` for each cell, an array of three or four nodes: triangles, then quads.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (const auto& nodes : triangles) visit(nodes);
    for (const auto& nodes : quads) visit(nodes);
  }
  template <class Visit>
  void for_each_cell(const Visit& visit) {
    for (auto& nodes : triangles) visit(nodes);
    for (auto& nodes : quads) visit(nodes);
  }
};

/// Returns the positions of a cell's nodes in a Mesh or a HaloMesh.
template <class AnyMesh, std::size_t width>
std::array<Point, width> corners_of(const AnyMesh& mesh, const std::array<NodeId, width>& nodes) {
  std::array<Point, width> corners;
  for (std::size_t i = 0; i < width; ++i) corners[i] = mesh.point(nodes[i]);
  return corners;
}

/// Numbers of nodes and cells over all ranks.
struct MeshCounts {
  std::int64_t nodes = 0, triangles = 0, quads = 0, boundary_edges = 0;
};

}  // namespace quadloop
