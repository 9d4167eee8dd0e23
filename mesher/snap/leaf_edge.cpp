#include "mesher/snap/leaf_edge.hpp"

#include <algorithm>

namespace quadloop {

LeafEdge leaf_edge_near(const LeafGraph& graph, const TreeGrid& grid, LeafId leaf, Side side, Point p) {
  const Quadrant& q = graph.leaf(leaf);
  LeafEdge edge{side, q.line(side), is_vertical(side) ? q.y : q.x, 0};
  edge.to = edge.from + q.size();
  if (graph.has_hanging(leaf, side)) {
    const std::int64_t middle = edge.from + q.size() / 2;
    (edge.along(p) < edge.at(grid, middle) ? edge.to : edge.from) = middle;
  }
  return edge;
}

double shortest_edge_of(const LeafGraph& graph, const TreeGrid& grid,
                        const std::array<LeafId, 4>& leaves_round) {
  int finest = 0;
  for (const LeafId leaf : leaves_round) {
    if (leaf != LeafGraph::none) finest = std::max(finest, graph.leaf(leaf).level);
  }
  return grid.edge(finest);
}

}  // namespace quadloop
