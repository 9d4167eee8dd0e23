#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The point of the closed segment a-b that is nearest to p, and how far it is. Both are computed in extended
/// precision and rounded at the end only, the same for b-a and for mirror images: mirrored outlines make
/// mirrored meshes. The distance comes from the area between p and the segment, as that of the rounded point
/// would be wrong where p lies close to it.
Point nearest_on_segment(Point p, Point a, Point b);
double distance_to_segment(Point p, Point a, Point b);

/// Where on a-b the point nearest to p lies.
struct PlaceOnSegment {
  double parameter = 0;  ///< 0 at a, 1 at b
  double squared_distance = 0;
};
/// In plain arithmetic, for searches that compare many segments and for places along an edge. Exact where an
/// end is nearest, so that edges with a common end are equally far from a point beyond it.
PlaceOnSegment place_on_segment(Point p, Point a, Point b);

}  // namespace quadloop
