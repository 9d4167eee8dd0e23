#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Calls `visit(from, to, cell)` for every edge of every cell, counter-clockwise; cells are numbered
/// triangles first, then quads.
template <class Visit>
void for_each_cell_edge(const Mesh& mesh, const Visit& visit) {
  std::int32_t cell = 0;
  const auto visit_cells = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      for (std::size_t k = 0; k < nodes.size(); ++k) visit(nodes[k], nodes[(k + 1) % nodes.size()], cell);
      ++cell;
    }
  };
  visit_cells(mesh.triangles);
  visit_cells(mesh.quads);
}

/// The cell to the left of each directed edge of one rank's cells. Linear in time and memory. The cells'
/// nodes must exist.
class EdgeTable {
 public:
  struct Edge {
    NodeId to;
    std::int32_t cell = -1;
  };

  explicit EdgeTable(const Mesh& mesh);

  /// The cell edges that start at a node, in the order of the cells.
  std::span<const Edge> from(NodeId node) const {
    const std::size_t at = node.value();
    return std::span(edges_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
  }
  /// Whether two cells have the same directed edge, i.e. overlap.
  bool repeats() const;
  /// Returns -1 if no cell has this directed edge; the first if several have it.
  std::int32_t cell_left_of(NodeId from_node, NodeId to) const {
    const auto edges = from(from_node);
    const auto found =
        std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.to == to; });
    return found == edges.end() ? -1 : found->cell;
  }

 private:
  std::vector<std::int64_t> starts_;
  std::vector<Edge> edges_;
};

/// The edges of one rank's cells with their neighbours, in lookup tables. The mesh's cells must not change.
class MeshTopology {
 public:
  /// An edge with a cell on its left and none on its right.
  struct OuterEdge {
    NodeId from, to;
  };

  /// What is stored: four bytes per cell edge, or only the boundary edges.
  enum class Kept { all, outer_edges };
  explicit MeshTopology(const Mesh& mesh, Kept kept = Kept::all);

  const EdgeTable& table() const { return table_; }
  /// For each cell edge, in the order of for_each_cell_edge(), the cell on its right, -1 if there is none.
  /// Empty if only outer edges are stored.
  std::span<const std::int32_t> beyond() const { return beyond_; }
  /// One of each directed edge, in the order of the cells.
  std::span<const OuterEdge> outer_edges() const { return outer_edges_; }

 private:
  EdgeTable table_;
  std::vector<std::int32_t> beyond_;
  std::vector<OuterEdge> outer_edges_;
};

}  // namespace quadloop
