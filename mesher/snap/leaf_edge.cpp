#include "mesher/snap/leaf_edge.hpp"

#include <algorithm>

namespace quadloop {

LeafEdge leaf_edge_near(const LeafGraph& graph, const Lattice& lattice, LeafId leaf, Side side, Point p) {
  const Quadrant& q = graph.leaf(leaf);
  LeafEdge edge{side, q.line(side), is_vertical(side) ? q.y : q.x, 0};
  edge.to = edge.from + q.size();
  if (graph.has_hanging(leaf, side)) {
    const std::int64_t middle = edge.from + q.size() / 2;
    (edge.along(p) < edge.at(lattice, middle) ? edge.to : edge.from) = middle;
  }
  return edge;
}

double shortest_edge_at(LeafFinder& finder, const Lattice& lattice, LatticePoint corner) {
  int finest = 0;
  for (const LeafId leaf : finder.leaves_round(corner)) {
    if (leaf != LeafGraph::none) finest = std::max(finest, finder.graph().leaf(leaf).level);
  }
  return lattice.edge(finest);
}

}  // namespace quadloop
