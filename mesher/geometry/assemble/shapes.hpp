#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Closed chains of exact curves or straight lines, named `name`; `source` is where the shape is defined, for
/// messages. The direction is open: assemble() puts the domain to their left.
Chain circle(const std::string& name, Point centre, double radius, const std::string& source);
Chain rectangle(const std::string& name, const Box& box, const std::string& source);
Chain polygon(const std::string& name, std::vector<Point> points, const std::string& source);
/// The spline through `points` points of each surface of a NACA section (NacaSection), of unit chord. Throws
/// InputError for a code that is none.
Chain naca_airfoil(const std::string& name, const std::string& code, bool sharp, int points,
                   const std::string& source);

}  // namespace quadloop
