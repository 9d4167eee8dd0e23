#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/assemble/naca_airfoil.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Closed chains of exact curves or straight lines, named `name`; `source` is where the shape is defined, for
/// messages. Their direction does not matter: assemble() puts the domain to their left.
Chain circle(const std::string& name, Point centre, double radius, const std::string& source);
Chain rectangle(const std::string& name, const Box& box, const std::string& source);
Chain polygon(const std::string& name, std::vector<Point> points, const std::string& source);
/// An open chain of straight lines, whose direction does not matter either.
Chain open_curve(const std::string& name, std::vector<Point> points, const std::string& source);
/// The splines through the points of an airfoil of unit chord, which request cells of 0.01. Throws InputError
/// as smooth_parts() does.
Chain naca_chain(const std::string& name, const NacaAirfoil& airfoil, const std::string& source);

}  // namespace quadloop
