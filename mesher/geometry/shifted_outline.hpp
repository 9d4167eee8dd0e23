#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

/// The outline moved to its left, into the domain, by less than any number: what the mesher cuts with. No
/// vertex of it lies on a lattice line, none of its segments passes through a lattice corner or runs along a
/// lattice line, so each question has two answers instead of three and all collinear and coincident cases
/// (thesis Fig. 3.10, 3.11) are ordinary ones. What lies on the outline itself is outside the domain; a
/// segment along a lattice line belongs to the leaf on its domain side. The rule knows left and right but not
/// up and down, so that mirrored and turned outlines give mirrored and turned answers.
///
/// A vertex moves along the mitre of its two segments; only the sign of that vector's components is needed,
/// and only for a vertex that lies on the line asked for.
class ShiftedOutline {
 public:
  explicit ShiftedOutline(const Geometry& geometry);

  const Geometry& geometry() const { return *geometry_; }

  /// Whether the vertex lies beyond the vertical line at x (right of it), or beyond the horizontal line at y
  /// (above it).
  bool beyond_x(std::int32_t vertex, double x) const {
    const double at = geometry_->point(vertex).x;
    return at != x ? at > x : shift_[vertex].x > 0;
  }
  bool beyond_y(std::int32_t vertex, double y) const {
    const double at = geometry_->point(vertex).y;
    return at != y ? at > y : shift_[vertex].y > 0;
  }

  /// Whether p lies to the left of the (infinite) line through the segment; a point on the outline's own line
  /// is right of the shifted one.
  bool has_left(std::int32_t segment, Point p) const {
    return orientation(geometry_->point(segment), geometry_->point(geometry_->next(segment)), p) > 0;
  }

  /// Whether the segment meets the inside of the box, whose sides are lattice lines.
  bool meets(std::int32_t segment, const Box& box) const;

 private:
  struct Shift {
    std::int8_t x = 0, y = 0;
  };
  Shift shift_of(std::int32_t vertex) const;

  const Geometry* geometry_;
  std::vector<Shift> shift_;
};

/// Where the segment from a to b, which crosses the vertical line at x, does so; the y coordinate, rounded
/// once. The same for the segment from b to a, and mirrored for mirrored arguments.
double crossing_height(Point a, Point b, double x);

}  // namespace quadloop
