#include "mesher/layers/layer_column.hpp"

#include <algorithm>

namespace quadloop {

namespace {

/// The point between two others at a place, independent of their order.
Point between(Point a, Point b, const FrontPlace& place) {
  return 0.5 * ((a + place.share * (b - a)) + (b + place.rest * (a - b)));
}

/// The foot of a column: it divides the wall between two stations in the ratio in which its node divides the
/// front. Independent of the direction of the wall.
Point foot_of(const WallLine& line, const FrontPlace& place) {
  const Point a = line[place.station].wall;
  if (place.at_station()) return a;
  const Point b = line[line.next(place.station)].wall;
  if (a == b) return a;
  return line.geometry().on_curve(line[place.station].segment, between(a, b, place));
}

/// The cosine of the angle between the column and the wall's normal, for the larger of two angles: to the
/// normals on both sides of a station, or at the two stations beside the place, where the wall may be curved.
/// 1 in a fan, where columns are normal to the wall.
double cosine_of_tilt(const WallLine& line, const FrontPlace& place, Point direction) {
  const Station& station = line[place.station];
  if (station.shape == Station::Shape::fan && (place.at_station() || line.width(place.station) == 0))
    return 1;
  const Point before = place.at_station() ? station.before : line[line.next(place.station)].before;
  return std::min(dot(direction, left_of(station.after)), dot(direction, left_of(before)));
}

/// The layers at a place. Between two stations the first height varies linearly, independently of the
/// direction of the wall. Growth is the larger limit of both, so that the column's length decides.
LayerSpec spec_at(const WallLine& line, const FrontPlace& place) {
  LayerSpec spec = line.spec(place.station);
  if (place.at_station()) return spec;
  const LayerSpec& next = line.spec(line.next(place.station));
  if (next == spec) return spec;
  const double here = spec.first;
  spec.first =
      0.5 * ((here + place.share * (next.first - here)) + (next.first + place.rest * (here - next.first)));
  spec.growth = std::max(spec.growth, next.growth);
  spec.growth_to = std::max(spec.growth_to, next.growth_to);
  return spec;
}

/// The curve on which the column lies; null for a straight column.
const EndPath* path_at(const WallLine& line, const FrontPlace& place) {
  return place.at_station() && line.ends_on_curve(place.station) ? &line.end_path(place.station) : nullptr;
}

}  // namespace

LayerColumn column_at(const LayerFront& front, const FrontPlace& given, Point node) {
  const WallLine& line = front.line;
  const FrontPlace place = place_of_column(line, given);
  const Point foot = foot_of(line, place), way = node - foot;
  const EndPath* const path = path_at(line, place);
  const double whole = path ? front.columns.length[place.station] : length(way);
  const Point direction = path ? path->direction() : (1 / whole) * way;
  const LayerSpec spec = spec_at(line, place);
  const double cosine = std::clamp(cosine_of_tilt(line, place, direction), 0.2, 1.0);
  return {foot, cosine, column_heights(spec, spec.first / cosine, whole)};
}

namespace {

/// Nodes at the column's heights from one point towards another, or along a path that is not null.
std::vector<Point> nodes_between(const ColumnHeights& heights, const EndPath* path, Point from, Point to) {
  const Point way = to - from;
  const double whole = length(way);
  std::vector<Point> nodes;
  nodes.reserve(heights.reached.size() - 1);
  if (path) {
    nodes.push_back(from);
    for (std::size_t layer = 1; layer + 1 < heights.reached.size(); ++layer)
      nodes.push_back(path->point_at(heights.reached[layer]));
    return nodes;
  }
  for (std::size_t layer = 0; layer + 1 < heights.reached.size(); ++layer)
    nodes.push_back(from + (heights.reached[layer] / whole) * way);
  return nodes;
}

}  // namespace

std::vector<Point> layer_column(const LayerFront& front, const FrontPlace& place, Point node) {
  const LayerColumn column = column_at(front, place, node);
  const EndPath* const path = path_at(front.line, place_of_column(front.line, place));
  return nodes_between(column.heights, path, column.foot, node);
}

Point point_of_front(const LayerFront& front, const FrontPlace& place) {
  const Point a = front.points[place.station];
  return place.at_station() ? a : between(a, front.points[front.line.next(place.station)], place);
}

std::vector<Point> column_on_foot(const LayerFront& front, const FrontPlace& place, Point foot) {
  const Point top = point_of_front(front, place);
  return nodes_between(column_at(front, place, top).heights, path_at(front.line, place), foot, top);
}

}  // namespace quadloop
