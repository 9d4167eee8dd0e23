#pragma once

#include <array>

#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// An edge of a leaf without interior nodes: a side, or half of a side with a hanging node.
struct LeafEdge {
  Side side = Side::bottom;
  std::int64_t line = 0;          ///< the grid line of the edge
  std::int64_t from = 0, to = 0;  ///< the grid lines at its ends, ascending

  bool vertical() const { return is_vertical(side); }
  /// The grid vertex at the position along the edge.
  GridPoint point(std::int64_t along) const {
    return vertical() ? GridPoint{line, along} : GridPoint{along, line};
  }
  /// The coordinate of the grid line at the position along the edge.
  double at(const TreeGrid& grid, std::int64_t along) const {
    return vertical() ? grid.y(along) : grid.x(along);
  }
  double length(const TreeGrid& grid) const { return at(grid, to) - at(grid, from); }
  /// The coordinates of a point along the edge and across it.
  double along(Point p) const { return vertical() ? p.y : p.x; }
  double across(Point p) const { return vertical() ? p.x : p.y; }
};

/// The edge of a leaf's side next to a point; with a hanging node, the half that contains it.
LeafEdge leaf_edge_near(const LeafGraph& graph, const TreeGrid& grid, LeafId leaf, Side side, Point p);

/// The edge length of the smallest leaf around a grid vertex; `leaves_round` as from LeafFinder.
double shortest_edge_of(const LeafGraph& graph, const TreeGrid& grid,
                        const std::array<LeafId, 4>& leaves_round);

}  // namespace quadloop
