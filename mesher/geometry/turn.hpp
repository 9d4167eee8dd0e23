#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Cosine and sine of an angle in degrees; exactly -1, 0 or 1 for multiples of 90.
Point unit_vector(double degrees);

/// The point p turned about another one by the angle of a unit vector.
Point turned_about(Point about, Point p, Point direction);

}  // namespace quadloop
