#include "mesher/layers/inverted_strips.hpp"

#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/layer_column.hpp"

namespace quadloop {

namespace {

bool turns_left(Point a, Point b, Point c) { return orientation(a, b, c) > 0; }

/// Of the cells between two columns, given from the wall to the front.
bool are_positive(const std::vector<Point>& a, const std::vector<Point>& b) {
  for (std::size_t ring = 1; ring < a.size(); ++ring) {
    const Point corners[] = {a[ring - 1], b[ring - 1], b[ring], a[ring]};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!turns_left(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4])) return false;
    }
  }
  return true;
}

std::vector<Point> column_to(const LayerFront& front, const FrontPlace& place, Point node) {
  std::vector<Point> column = layer_column(front, place, node);
  column.push_back(node);
  return column;
}

/// After the first place, before the second one.
std::vector<std::int32_t> stations_between(const WallLine& line, const FrontPlace& first,
                                           const FrontPlace& second) {
  std::vector<std::int32_t> stations;
  for (std::int32_t i = first.station; i != second.station;) {
    i = line.next(i);
    if (i != second.station || !second.at_station()) stations.push_back(i);
  }
  return stations;
}

/// Whether both lie in one fan, so that no wall is between their columns.
bool in_one_fan(const WallLine& line, const FrontPlace& first, const FrontPlace& second) {
  for (std::int32_t i = first.station; i != second.station; i = line.next(i)) {
    if (line.width(i) > 0) return false;
  }
  return second.at_station() || line.width(second.station) == 0;
}

}  // namespace

std::vector<InvertedStrip> inverted_strips(const LayerFront& front, const Mesh& outer,
                                           const std::vector<std::vector<std::int32_t>>& edge_leaves) {
  const FrontPlaces places(front);
  std::vector<InvertedStrip> strips;
  for (std::size_t b = 0; b < outer.boundaries.size(); ++b) {
    const BoundaryId boundary{static_cast<std::int32_t>(b)};
    const auto& edges = outer.boundaries[b].edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Point from = outer.point(edges[e][0]), to = outer.point(edges[e][1]);
      const FrontPlace first = places.locate(from, boundary), second = places.locate(to, boundary);
      if (!places.follows(first, second) || in_one_fan(front.line, first, second)) continue;
      if (are_positive(column_to(front, first, from), column_to(front, second, to))) continue;
      strips.push_back({edges[e], edge_leaves[b][e], stations_between(front.line, first, second)});
    }
  }
  return strips;
}

}  // namespace quadloop
