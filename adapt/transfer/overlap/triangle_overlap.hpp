#pragma once

#include <array>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// What two triangles have in common.
struct TriangleOverlap {
  double area = 0;
  Point centroid;  ///< from the first corner of the triangle that is cut: far from the origin nothing is lost
};

/// Of two counter-clockwise triangles: `clipped` cut by the three lines of `by` (Sutherland and Hodgman,
/// 1974). On which side a corner lies is told exactly, so that triangles which only touch have nothing in
/// common; areas are right to rounding, also far from the origin.
TriangleOverlap overlap_of(const std::array<Point, 3>& clipped, const std::array<Point, 3>& by);

}  // namespace quadloop
