#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Drops points whose distance from the previous one along each axis is at most `within`, with the segments
/// between them; of a closed chain also last points as near to the first. An open chain keeps its ends, if
/// they differ. Returns the number of dropped points and the first of them.
std::pair<std::int64_t, Point> drop_repeats(Chain& chain, double within);

/// The segments in reverse order, each from its other end.
std::vector<Curve> reversed(std::vector<Curve> curves);

/// The box of chains with their curves, up to rounding.
Box box_of(std::span<const Chain> chains);

/// Continues a chain by a segment from its last point. The chain must have a point.
void append_segment(Chain& chain, Curve curve, Point to);
inline void append_line(Chain& chain, Point to) { append_segment(chain, {}, to); }

/// An arc of an ellipse: centre + cos(t) major + sin(t) minor for t from `begin` to `end`, in radians;
/// clockwise if `end` is the smaller one. A circle has perpendicular half axes of equal length.
struct EllipticArc {
  Point centre, major, minor;
  double begin = 0, end = 0;

  Point point_at(double t) const;
};

/// Continues a chain by an arc as rational quadratic curves of at most 90 degrees. The arc's first point is
/// the chain's last one, which keeps its coordinates; `to`: the coordinates of its last point, if known.
void append_arc(Chain& chain, const EllipticArc& arc, std::optional<Point> to = {});

/// The circular arc between two points of a drawing's polyline: `bulge` is the tangent of a quarter of its
/// angle, positive for counter-clockwise arcs; 0: a line.
void append_bulge(Chain& chain, double bulge, Point to);

/// A B-spline: poles.size() + degree + 1 knots in ascending order; weights for each pole, or none.
struct BSpline {
  int degree = 3;
  std::vector<double> knots;
  std::vector<Point> poles;
  std::vector<double> weights;
};

/// Why a B-spline is not well formed, for messages; empty if it is: a degree from 1 to 15, the numbers of
/// knots and weights, knots in ascending order with a range to evaluate, finite values, positive weights.
std::string fault_of(const BSpline& spline);

/// The first point of a well-formed B-spline.
Point start_of(const BSpline& spline);

/// Continues a chain by a well-formed B-spline, which begins at the chain's last point, as one Bézier curve
/// for each interval of different knots (evaluated by blossoms: Ramshaw 1987).
void append_bspline(Chain& chain, const BSpline& spline);

/// Continues a chain by a cubic spline through its last point and all of `points`, with continuous second
/// derivatives in the chord length and, at the ends, continuous third derivatives at the next point
/// ("not-a-knot"). Directions at the ends are free or given. Each curve requests the distance of its ends as
/// spacing.
struct EndDirections {
  std::optional<Point> start, end;  ///< need not be unit vectors
};
void append_spline(Chain& chain, std::span<const Point> points, const EndDirections& directions = {});

/// Joins the points of a chain of straight segments by cubic splines from corner to corner. A corner turns by
/// more than `corner_degrees`, and by more than 60 degrees or twice as much as both its neighbours: points on
/// a sharply curved nose are none. A closed chain without corners becomes a periodic spline.
void join_by_splines(Chain& chain, double corner_degrees);

}  // namespace quadloop
