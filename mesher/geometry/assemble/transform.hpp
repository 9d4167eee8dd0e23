#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// How the coordinates of a geometry file are placed: scaled about the origin, then rotated counter-clockwise
/// about a point, then moved.
struct Transform {
  double scale = 1;  ///< > 0
  double rotate_degrees = 0;
  Point translate;
  Point rotate_about = {};  ///< in scaled coordinates
};

/// The point placed. Quarter turns are exact: no sine of 90 degrees is rounded.
Point transformed(Point p, const Transform& transform);
void apply(const Transform& transform, std::vector<Chain>& chains);

/// The square of the given half width around the centre of the chains' box. Throws InputError, naming `where`
/// the setting stands, as add_far_field does.
Box far_field_box(const std::vector<Chain>& chains, double half_width, const std::string& where);

/// Adds a closed boundary "farfield" along the sides of the square. Throws InputError where a boundary has
/// that name already, or where the square does not enclose the chains; `where` names the setting in messages.
void add_far_field(std::vector<Chain>& chains, const Box& square, const std::string& where);

}  // namespace quadloop
