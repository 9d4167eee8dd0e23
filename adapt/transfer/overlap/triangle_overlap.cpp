#include "adapt/transfer/overlap/triangle_overlap.hpp"

#include <algorithm>
#include <cstddef>

#include "mesher/geometry/predicates.hpp"

namespace quadloop::adapt {

namespace {

/// At most six corners; rounding may temporarily add a seventh.
struct Polygon {
  std::array<Point, 12> corners;
  std::size_t count = 0;

  void add(Point p) {
    if (count < corners.size()) corners[count++] = p;
  }
};

/// The fraction of an edge at which it crosses a line, for ends whose heights over the line have different
/// signs. The signs are exact and the heights rounded: if the edge lies on the line within rounding the
/// heights may be equal; any of its points is then valid.
double crossing_fraction(double height_from, double height_to) {
  const double fall = height_from - height_to;
  return fall == 0 ? 0.5 : std::clamp(height_from / fall, 0.0, 1.0);
}

/// orientation(), without the exact test for the usual cases in which p is on the line.
int side_of(Point a, Point b, Point p) {
  const bool on_line = p == a || p == b || (p.x == a.x && p.x == b.x) || (p.y == a.y && p.y == b.y);
  return on_line ? 0 : orientation(a, b, p);
}

/// The part to the left of the line from a to b.
Polygon left_part(const Polygon& polygon, Point a, Point b) {
  std::array<int, std::tuple_size_v<decltype(polygon.corners)>> sides{};
  bool any_left = false, any_right = false;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    sides[k] = side_of(a, b, polygon.corners[k]);
    any_left |= sides[k] > 0;
    any_right |= sides[k] < 0;
  }
  if (!any_left) return {};
  if (!any_right) return polygon;
  Polygon left;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const std::size_t next = k + 1 < polygon.count ? k + 1 : 0;
    const Point from = polygon.corners[k], to = polygon.corners[next];
    if (sides[k] >= 0) left.add(from);
    if (sides[k] * sides[next] >= 0) continue;
    const double height_from = cross(b - a, from - a), height_to = cross(b - a, to - a);
    left.add(from + crossing_fraction(height_from, height_to) * (to - from));
  }
  return left;
}

}  // namespace

TriangleOverlap overlap_of(const std::array<Point, 3>& clipped, const std::array<Point, 3>& by) {
  const Point origin = clipped[0];  // relative coordinates keep precision
  Polygon polygon;
  for (const Point p : clipped) polygon.add(p - origin);
  for (std::size_t k = 0; k < 3 && polygon.count > 0; ++k)
    polygon = left_part(polygon, by[k] - origin, by[(k + 1) % 3] - origin);
  double twice_area = 0;
  Point moment;
  for (std::size_t k = 1; k + 1 < polygon.count; ++k) {
    const Point a = polygon.corners[k] - polygon.corners[0], b = polygon.corners[k + 1] - polygon.corners[0];
    twice_area += cross(a, b);
    moment = moment + cross(a, b) * (a + b);
  }
  if (!(twice_area > 0)) return {};
  return {0.5 * twice_area, polygon.corners[0] + (1 / (3 * twice_area)) * moment};
}

}  // namespace quadloop::adapt
