#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop::euler {

/// The integral over a face of place, from the middle of its edge, times normal: normals that go with the
/// gradient along x and along y.
struct Skewness {
  Point with_x, with_y;
};

inline Skewness operator+(const Skewness& a, const Skewness& b) {
  return {a.with_x + b.with_x, a.with_y + b.with_y};
}
inline Skewness operator*(double factor, const Skewness& s) { return {factor * s.with_x, factor * s.with_y}; }

/// How near a node's neighbours are in each direction: the sum over its edges of d d^T / |d|^4.
struct Nearness {
  double xx = 0, xy = 0, yy = 0;

  void add(Point edge) {
    const double square = dot(edge, edge), weight = 1 / (square * square);
    xx += weight * edge.x * edge.x;
    xy += weight * edge.x * edge.y;
    yy += weight * edge.y * edge.y;
  }
  /// A way from the node in units of the edges that lie along it, about: 1.4 for such an edge in a square
  /// grid.
  double reach(Point way) const {
    return std::sqrt(way.x * way.x * xx + 2 * way.x * way.y * xy + way.y * way.y * yy);
  }
};

/// An edge's face, as long as its normal, and what is skew in it: by its own middle, and what triangles would
/// leave over for the next edge (1 / 24 of the edge squared).
struct SkewFace {
  Point edge;    ///< from one node to the other
  double size;   ///< of the face
  Point normal;  ///< of length 1
  Skewness of_middle, left_over, sum;
};

/// How much of what is left over an edge bears, 0 to 1, which the halves of a boundary face share: less than
/// all at long thin cells, whose faces are small beside the edge.
double share_left_over(double length, double size);

/// The skewness that an implicit scheme bears. The gradient at a node is what its nearest neighbours say;
/// where it is carried much farther than they are, as to the middle of a face of a thin cell on a curved wall
/// or of a long cell beside a short one, it is no small correction but swings up. Cells of moderate shape
/// keep all, to the last bit.
Skewness bearable(const SkewFace& face, const Nearness& low, const Nearness& high);

}  // namespace quadloop::euler
