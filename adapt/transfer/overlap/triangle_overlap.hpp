#pragma once

#include <array>

#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// The intersection of two triangles.
struct TriangleOverlap {
  double area = 0;
  Point centroid;  ///< relative to the first corner of `clipped`, to keep precision far from the origin
};

/// Intersects two counter-clockwise triangles: clips `clipped` by the three lines of `by` (Sutherland and
/// Hodgman, 1974). Sides are decided by exact predicates, so that triangles which only touch have no overlap;
/// areas are accurate to rounding, also far from the origin.
TriangleOverlap overlap_of(const std::array<Point, 3>& clipped, const std::array<Point, 3>& by);

}  // namespace quadloop::adapt
