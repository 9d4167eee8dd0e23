#pragma once

#include <utility>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The shape of a segment between its two ends: a straight line or a rational Bézier curve, whose degree is
/// at most `largest_degree`. The first and the last control point are the ends of the segment, which are
/// stored with the segment.
struct Curve {
  static constexpr int largest_degree = 15;
  std::vector<Point> inner;     ///< control points between the ends; none: a straight line
  std::vector<double> weights;  ///< of all control points, ends included; positive; empty: all are 1
  /// The cell size that the curve requests, as the length of a straight segment does; 0: the length of its
  /// chord.
  double spacing = 0;
  bool interpolates = false;  ///< joins given points: the shape between them is not given

  bool straight() const { return inner.empty(); }
  std::size_t degree() const { return inner.size() + 1; }

  friend bool operator==(const Curve&, const Curve&) = default;
};

/// A curve with its ends.
struct CurvedSegment {
  Point from;
  Curve curve = {};
  Point to = {};
};

/// The same curve, from its other end.
Curve reversed(Curve curve);
CurvedSegment reversed(CurvedSegment segment);

/// The box of the control points, which contains the curve.
Box box_of(const CurvedSegment& segment);

/// The two halves of the curve at parameter 0.5. Halves of the reversed curve are the reversed halves, bit by
/// bit. Both request the spacing of the whole.
std::pair<CurvedSegment, CurvedSegment> halves(const CurvedSegment& segment);

/// The point at a parameter from 0 to 1.
Point point_at(const CurvedSegment& segment, double parameter);

/// Unit direction of the curve at its first and at its last point.
Point direction_at_start(const CurvedSegment& segment);
Point direction_at_end(const CurvedSegment& segment);

/// The largest distance of a control point from the chord: no point of the curve is farther from it.
double height_of_hull(const CurvedSegment& segment);

/// The sum of the turning angles of the control polygon, in degrees: the curve does not turn by more.
double turning_of_hull(const CurvedSegment& segment);

/// A point of a curve and the unit direction of the curve there.
struct CurvePoint {
  Point point, direction;
};

/// The point of the curve whose foot on the chord is that of p. A curve that turns by less than 90 degrees
/// has exactly one such point for each foot between the ends; beyond the ends the result is the nearer end.
/// A bracketed Newton iteration finds it from either end of the curve; the result is the mean, so that the
/// reversed curve gives the same point, bit by bit.
CurvePoint above_chord(const CurvedSegment& segment, Point p);

}  // namespace quadloop
