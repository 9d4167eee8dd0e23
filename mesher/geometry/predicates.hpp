#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Exact predicates on the given coordinates: filtered floating point, then exact arithmetic where the filter
/// fails. For each, exactly: a cyclic shift of the arguments keeps the result; an exchange of two, or a
/// mirror image, negates it.

/// Same as orientation(), without the filter.
int exact_orientation(Point a, Point b, Point c);

/// +1 if a, b, c turn left (counter-clockwise), -1 if they turn right, 0 if they are collinear. The filter's
/// bound is that of Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates" (1997), section 4.3; it does not hold where products underflow.
inline int orientation(Point a, Point b, Point c) {
  constexpr double bound_of_sum = 3.3306690738754716e-16, no_underflow = 0x1p-960;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right, sum = std::abs(left) + std::abs(right);
  if (sum > no_underflow && std::abs(determinant) > bound_of_sum * sum) return determinant > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

/// For a counter-clockwise triangle a, b, c: +1 if d lies inside its circumcircle, -1 outside, 0 on it.
int in_circle(Point a, Point b, Point c, Point d);

/// Whether the closed segments a-b and c-d have a point in common.
bool segments_meet(Point a, Point b, Point c, Point d);

/// Whether p lies on the closed segment a-b.
bool on_segment(Point p, Point a, Point b);

}  // namespace quadloop
