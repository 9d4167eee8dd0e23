#pragma once

#include <array>

#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// An edge of a leaf without nodes inside: a side, or half of one that has a hanging node.
struct LeafEdge {
  Side side = Side::bottom;
  std::int64_t line = 0;          ///< the lattice line that it lies on
  std::int64_t from = 0, to = 0;  ///< the lattice lines at its ends, in ascending order

  bool vertical() const { return is_vertical(side); }
  /// The lattice point at the position along the edge.
  LatticePoint point(std::int64_t along) const {
    return vertical() ? LatticePoint{line, along} : LatticePoint{along, line};
  }
  /// Where the edge has the lattice line at the position along it.
  double at(const Lattice& lattice, std::int64_t along) const {
    return vertical() ? lattice.y(along) : lattice.x(along);
  }
  double length(const Lattice& lattice) const { return at(lattice, to) - at(lattice, from); }
  /// The coordinate of a point along the edge, and across it.
  double along(Point p) const { return vertical() ? p.y : p.x; }
  double across(Point p) const { return vertical() ? p.x : p.y; }
};

/// The edge of a leaf's side next to a point; beyond the middle, the half in which it lies.
LeafEdge leaf_edge_near(const LeafGraph& graph, const Lattice& lattice, LeafId leaf, Side side, Point p);

/// The edge of the smallest of the leaves round a lattice corner, as LeafFinder has them.
double shortest_edge_of(const LeafGraph& graph, const Lattice& lattice,
                        const std::array<LeafId, 4>& leaves_round);

}  // namespace quadloop
