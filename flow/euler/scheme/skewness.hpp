#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop::flow::euler {

/// The integral over a face of position, relative to its edge's midpoint, times normal: normals for the
/// gradient along x and along y.
struct Skewness {
  Point with_x, with_y;
};

inline Skewness operator+(const Skewness& a, const Skewness& b) {
  return {a.with_x + b.with_x, a.with_y + b.with_y};
}
inline Skewness operator*(double factor, const Skewness& s) { return {factor * s.with_x, factor * s.with_y}; }

/// Proximity of a node's neighbours in each direction: the sum over its edges of d d^T / |d|^4.
struct Nearness {
  double xx = 0, xy = 0, yy = 0;

  void add(Point edge) {
    const double square = dot(edge, edge), weight = 1 / (square * square);
    xx += weight * edge.x * edge.x;
    xy += weight * edge.x * edge.y;
    yy += weight * edge.y * edge.y;
  }
  /// Length of a vector from the node, approximately in units of the edges along it: 1.4 for such an edge in
  /// a square grid.
  double reach(Point way) const {
    return std::sqrt(way.x * way.x * xx + 2 * way.x * way.y * xy + way.y * way.y * yy);
  }
};

inline Nearness turned(const Nearness& nearness, Point direction) {
  const auto& [xx, xy, yy] = nearness;
  const double c = direction.x, s = direction.y;
  return {c * c * xx - 2 * c * s * xy + s * s * yy, c * s * (xx - yy) + (c * c - s * s) * xy,
          s * s * xx + 2 * c * s * xy + c * c * yy};
}

/// The face of an edge with its skewness: by its own midpoint, and the part that triangles pass on to the
/// next edge (1 / 24 of the edge squared).
struct SkewFace {
  Point edge;    ///< from one node to the other
  double size;   ///< of the face
  Point normal;  ///< unit normal
  Skewness of_middle, left_over, sum;
};

/// Fraction, 0 to 1, of the passed-on part that an edge keeps; the halves of a boundary face use it too. Less
/// than 1 at long thin cells, whose faces are small compared with the edge.
double share_left_over(double length, double size);

/// Returns the skewness that is stable in an implicit scheme. The gradient at a node is determined by its
/// nearest neighbours; extrapolated much farther, e.g. to the midpoint of a face of a thin cell on a curved
/// wall or of a long cell next to a short one, the correction is large and unstable. Cells of moderate shape
/// keep all of it, bitwise.
Skewness bearable(const SkewFace& face, const Nearness& low, const Nearness& high);

}  // namespace quadloop::flow::euler
