#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Where the lines through a-b and c-d cross, which are not parallel: the exact point, each coordinate
/// rounded once to the nearest double. The same for every order of the arguments.
Point crossing_point(Point a, Point b, Point c, Point d);

}  // namespace quadloop
