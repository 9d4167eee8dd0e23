#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The intersection of the lines through a-b and c-d, which are not parallel: the exact point with each
/// coordinate rounded once to the nearest double. Independent of the order of the arguments.
Point crossing_point(Point a, Point b, Point c, Point d);

}  // namespace quadloop
