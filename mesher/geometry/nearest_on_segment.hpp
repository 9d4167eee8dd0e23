#pragma once

#include <span>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The point of the closed segment a-b nearest to p, and its distance. Both are computed in extended
/// precision and rounded at the end, with the same result for b-a and for mirror images: mirrored geometries
/// give mirrored meshes. The distance is computed from the area between p and the segment, as the distance to
/// the rounded point would be inaccurate for p close to it.
Point nearest_on_segment(Point p, Point a, Point b);
double distance_to_segment(Point p, Point a, Point b);

/// The place on a-b of the point nearest to p.
struct PlaceOnSegment {
  double parameter = 0;  ///< 0 at a, 1 at b
  double squared_distance = 0;
};
/// In plain arithmetic, for searches over many segments and for places along an edge. Exact if an end is
/// nearest, so that edges with a common end have the same distance from a point beyond it.
PlaceOnSegment place_on_segment(Point p, Point a, Point b);

/// The nearest point of a polyline of two or more points, and its distance; also in plain arithmetic.
Point nearest_on_polyline(Point p, std::span<const Point> polyline);
double distance_to_polyline(Point p, std::span<const Point> polyline);

}  // namespace quadloop
