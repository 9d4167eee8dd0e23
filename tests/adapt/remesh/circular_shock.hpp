#pragma once

#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop::test {

/// Rises by 2 across a circle about the origin.
inline double circular_shock(Point p) { return std::tanh(30 * (std::hypot(p.x, p.y) - 0.6)); }

}  // namespace quadloop::test
