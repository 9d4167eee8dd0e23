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

/// `rounded_front`: the letter C, a square whose left half is a half circle.
enum class FarFieldShape { square, rectangle, circle, rounded_front };

/// The bounding box of a far field: a square of the given half width around the centre of the chains'
/// bounding box, or, for a rectangle, that box extended by `radius` on each side. Throws InputError as
/// add_far_field does; `where` names the setting.
Box far_field_box(const std::vector<Chain>& chains, FarFieldShape shape, double radius,
                  const std::string& where);

/// Adds a closed boundary "farfield" of this shape in the box. Throws InputError if a boundary already has
/// that name or the far field does not enclose the chains; `where` names the setting in messages.
void add_far_field(std::vector<Chain>& chains, FarFieldShape shape, const Box& box, const std::string& where);

}  // namespace quadloop
