#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/turn.hpp"

namespace quadloop {

/// The placement of a geometry file: its coordinates are scaled about the origin, then rotated
/// counter-clockwise about a point, then moved.
struct Transform {
  double scale = 1;  ///< > 0
  double rotate_degrees = 0;
  Point translate;
  Point rotate_about = {};  ///< in scaled coordinates
};

/// Places the points. Quarter turns are exact: no sine of 90 degrees is rounded.
void apply(const Transform& transform, std::vector<Chain>& chains);

/// The square with the given half width around the centre of the chains' bounding box. Throws InputError as
/// add_far_field does; `where` names the setting.
Box far_field_box(const std::vector<Chain>& chains, double half_width, const std::string& where);

/// Adds a closed boundary "farfield" along the sides of the square. Throws InputError if a boundary already
/// has that name or the square does not enclose the chains; `where` names the setting in messages.
void add_far_field(std::vector<Chain>& chains, const Box& square, const std::string& where);

}  // namespace quadloop
