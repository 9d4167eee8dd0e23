#pragma once

#include <functional>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The smallest size of cells that adaptation requests on the segment between two points, or `most` if that
/// is smaller. It does not depend on the order of the points; mirror images have the same sizes. Empty: no
/// requests.
using AdaptedSize = std::function<double(Point a, Point b, double most)>;

}  // namespace quadloop
