#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Exact decisions on the coordinates as they are given (filtered floating point first, exact arithmetic where that
/// cannot tell). Each obeys, exactly: a cyclic shift of the arguments keeps the answer, an exchange of two negates it, and so
/// does a mirror image.

/// +1 where a, b, c turn left (counter-clockwise), -1 where they turn right, 0 where they lie on one line.
int orientation(Point a, Point b, Point c);

/// For a counter-clockwise triangle a, b, c: +1 where d lies inside its circumcircle, -1 outside, 0 on it.
int in_circle(Point a, Point b, Point c, Point d);

/// Whether the closed segments a-b and c-d have a point in common.
bool segments_meet(Point a, Point b, Point c, Point d);

/// Whether p lies on the closed segment a-b.
bool on_segment(Point p, Point a, Point b);

}  // namespace quadloop
