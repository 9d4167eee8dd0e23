#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Whether the angle at p between a and b is certainly acute, despite rounding; may be false for an angle
/// slightly below 90 degrees. An edge opposite two such angles is Delaunay.
inline bool surely_acute(Point a, Point p, Point b) {
  constexpr double rounding = 1e-15, underflow = 1e-290;
  const double along_x = (a.x - p.x) * (b.x - p.x), along_y = (a.y - p.y) * (b.y - p.y);
  return along_x + along_y > rounding * (std::abs(along_x) + std::abs(along_y)) + underflow;
}

/// A bit for each corner of a triangle, the lowest for a, whose angle may not be acute. Branch-free, as the
/// outcome is unpredictable.
inline unsigned blunt_corners(Point a, Point b, Point c) {
  return unsigned{!surely_acute(b, a, c)} | unsigned{!surely_acute(c, b, a)} << 1U |
         unsigned{!surely_acute(a, c, b)} << 2U;
}

/// Whether the angle at p is exactly right, with its sides along x and y.
inline bool is_right_along_axes(Point a, Point p, Point b) {
  return (a.x == p.x && b.y == p.y) || (a.y == p.y && b.x == p.x);
}

}  // namespace quadloop
