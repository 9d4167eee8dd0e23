#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Rank of a mesh node for the choice between the diagonals of four nodes on one circle: the diagonal through
/// the node of the highest rank is used. It consists of numbers that are invariant under reflections and
/// quarter turns of the root (or of a single leaf); only mirror images are distinguished by their
/// coordinates. In a mesh the order is strict, so the constrained Delaunay triangulation is unique: nodes on
/// one circle are joined to the highest of them.
struct TieRank {
  /// Trailing zeros of a grid vertex's integer coordinates, the smaller first; -1 for other nodes.
  std::int8_t coarser = -1, finer = -1;
  /// Distances along the axes, the larger first: from the root's centre, or from a leaf's corner of the
  /// highest rank.
  double farther = 0, nearer = 0;
  double x = 0, y = 0;
  friend auto operator<=>(const TieRank&, const TieRank&) = default;
};

/// Rank by position only: nodes farther from the centre of a box rank higher.
inline TieRank tie_rank(Point centre, Point position) {
  const double across = std::abs(position.x - centre.x), up = std::abs(position.y - centre.y);
  return {-1, -1, std::max(across, up), std::min(across, up), position.x, position.y};
}

}  // namespace quadloop
