#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Exact decisions on the coordinates as they are given (filtered floating point first, exact arithmetic
/// where that cannot tell). Each obeys, exactly: a cyclic shift of the arguments keeps the answer, an
/// exchange of two negates it, and so does a mirror image.

/// As orientation, without the filter.
int exact_orientation(Point a, Point b, Point c);

/// +1 where a, b, c turn left (counter-clockwise), -1 where they turn right, 0 where they lie on one line.
/// The filter's bound is that of Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates" (1997), section 4.3; it does not hold where products underflow.
inline int orientation(Point a, Point b, Point c) {
  constexpr double bound_of_sum = 3.3306690738754716e-16, no_underflow = 0x1p-960;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right, sum = std::abs(left) + std::abs(right);
  if (sum > no_underflow && std::abs(determinant) > bound_of_sum * sum) return determinant > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

/// For a counter-clockwise triangle a, b, c: +1 where d lies inside its circumcircle, -1 outside, 0 on it.
int in_circle(Point a, Point b, Point c, Point d);

/// Whether the closed segments a-b and c-d have a point in common.
bool segments_meet(Point a, Point b, Point c, Point d);

/// Whether p lies on the closed segment a-b.
bool on_segment(Point p, Point a, Point b);

}  // namespace quadloop
