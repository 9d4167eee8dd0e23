#include "mesher/geometry/nearest_on_segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace quadloop {

namespace {

using Wide = long double;

/// Makes both directions of the segment round in the same way.
void put_nearer_end_first(Point p, Point& a, Point& b) {
  if (dot(p - b, p - b) < dot(p - a, p - a)) std::swap(a, b);
}

}  // namespace

Point nearest_on_segment(Point p, Point a, Point b) {
  put_nearer_end_first(p, a, b);
  const Wide dx = Wide(b.x) - a.x, dy = Wide(b.y) - a.y;
  const Wide along = (Wide(p.x) - a.x) * dx + (Wide(p.y) - a.y) * dy, square = dx * dx + dy * dy;
  if (along <= 0) return a;
  if (along >= square) return b;
  const Wide t = along / square;
  return {static_cast<double>(a.x + t * dx), static_cast<double>(a.y + t * dy)};
}

double distance_to_segment(Point p, Point a, Point b) {
  put_nearer_end_first(p, a, b);
  const Wide abx = Wide(b.x) - a.x, aby = Wide(b.y) - a.y, apx = Wide(p.x) - a.x, apy = Wide(p.y) - a.y;
  const Wide square = abx * abx + aby * aby, along = apx * abx + apy * aby;
  if (square == 0 || along <= 0) return length(p - a);
  if (along >= square) return length(p - b);
  const Wide twice_area = abx * apy - aby * apx;
  return std::sqrt(static_cast<double>(twice_area * twice_area / square));
}

PlaceOnSegment place_on_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double parameter = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  const Point off = parameter == 1 ? b - p : a + parameter * along - p;
  return {parameter, dot(off, off)};
}

Point nearest_on_polyline(Point p, std::span<const Point> polyline) {
  double least = std::numeric_limits<double>::infinity();
  Point nearest = polyline[0];
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const auto [parameter, squared_distance] = place_on_segment(p, polyline[i - 1], polyline[i]);
    if (squared_distance >= least) continue;
    least = squared_distance;
    nearest = polyline[i - 1] + parameter * (polyline[i] - polyline[i - 1]);
  }
  return nearest;
}

double distance_to_polyline(Point p, std::span<const Point> polyline) {
  return length(nearest_on_polyline(p, polyline) - p);
}

}  // namespace quadloop
