#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

/// The geometry, shifted to its left (into the domain) by an infinitesimal distance, as used for cutting.
/// None of its vertices lies on a grid line of the quadtree, and none of its segments passes through a grid
/// vertex or runs along a grid line. So each query has two results instead of three, and collinear and
/// coincident cases (thesis Fig. 3.10, 3.11) need no special treatment. Points on the geometry itself are
/// outside the domain; a segment along a grid line belongs to the leaf on its domain side. The rule
/// distinguishes left and right but not up and down, so that mirrored and rotated geometries give mirrored
/// and rotated results.
///
/// A vertex moves along the mitre of its two segments. Only the signs of that vector's components are needed,
/// and only for a vertex on the line in question.
class ShiftedOutline {
 public:
  explicit ShiftedOutline(const Geometry& geometry);

  const Geometry& geometry() const { return *geometry_; }

  /// Whether the vertex lies beyond the vertical line at x (to its right), or beyond the horizontal line at y
  /// (above it).
  bool beyond_x(std::int32_t vertex, double x) const {
    const double at = geometry_->point(vertex).x;
    return at != x ? at > x : shift_[vertex].x > 0;
  }
  bool beyond_y(std::int32_t vertex, double y) const {
    const double at = geometry_->point(vertex).y;
    return at != y ? at > y : shift_[vertex].y > 0;
  }

  /// Whether the vertex lies in the box, whose sides are grid lines. A vertex where the geometry passes
  /// through a peak on a side lies in the boxes on both sides, so that mirror images agree.
  bool is_in(const Box& box, std::int32_t vertex) const {
    const Point p = geometry_->point(vertex);
    const auto [x, y] = shift_[vertex];
    return (beyond_x(vertex, box.low.x) || (p.x == box.low.x && x == -through_peak)) &&
           (!beyond_x(vertex, box.high.x) || (p.x == box.high.x && x == through_peak)) &&
           (beyond_y(vertex, box.low.y) || (p.y == box.low.y && y == -through_peak)) &&
           (!beyond_y(vertex, box.high.y) || (p.y == box.high.y && y == through_peak));
  }

  /// Whether p lies to the left of the (infinite) line through the segment; a point on the line is to the
  /// right of the shifted one, except ahead of an inner line that ends where the segment begins: the shifted
  /// segment begins beyond that end, on the other side of the line.
  bool has_left(std::int32_t segment, Point p) const {
    const int side = orientation(geometry_->point(segment), geometry_->point(geometry_->next(segment)), p);
    return side != 0 ? side > 0 : geometry_->is_tip(segment) && is_ahead_of_start(segment, p);
  }

  /// The segment's contribution to the winding number at p, by the ray to its left: 1 for a downward
  /// crossing, -1 for an upward one.
  int winding_at(std::int32_t segment, Point p) const;
  /// The change of the winding number from one point of a grid line to another, caused by the segment.
  int winding_between(std::int32_t segment, Point from, Point to) const;

  /// Whether the segment meets the interior of the box, whose sides are grid lines.
  bool meets(std::int32_t segment, const Box& box) const;

 private:
  /// A shift with a sign that does not matter: the geometry passes through a peak on the line.
  static constexpr std::int8_t through_peak = 2;
  struct Shift {
    std::int8_t x = 0, y = 0;
  };
  static std::int8_t mitre_sign(int in_along, int in_other, int out_along, int out_other, int turn,
                                int handed);
  Shift shift_of(std::int32_t vertex) const;
  /// Whether a point on the line through the segment lies before its start.
  bool is_ahead_of_start(std::int32_t segment, Point p) const;

  const Geometry* geometry_;
  std::vector<Shift> shift_;
};

/// The y coordinate, rounded once, where the segment a-b crosses the vertical line at x. The same for b-a,
/// and mirrored for mirrored arguments.
double crossing_height(Point a, Point b, double x);

}  // namespace quadloop
