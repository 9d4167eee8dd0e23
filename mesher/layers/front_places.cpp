#include "mesher/layers/front_places.hpp"

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

FrontPlaces::FrontPlaces(const LayerFront& front)
    : front_{&front}, of_boundary_(front.outer.boundaries().size()) {
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    if (front.station_of[s] != WallLine::none) of_boundary_[front.outer.boundary_of(s)].segments.push_back(s);
  }
  for (const BoundaryId b : of_boundary_.ids()) {
    std::vector<Box> boxes;
    for (const std::int32_t s : of_boundary_[b].segments)
      boxes.push_back(box_of(front.outer.point(s), front.outer.point(front.outer.next(s))));
    of_boundary_[b].tree = BoxTree(boxes);
  }
}

FrontPlace FrontPlaces::locate(Point node, BoundaryId boundary) const {
  const Geometry& outer = front_->outer;
  const auto& [segments, tree] = of_boundary_[boundary];
  const std::int32_t nearest = tree.nearest(node, [&](std::int32_t k) {
    const std::int32_t s = segments[k];
    return place_on_segment(node, outer.point(s), outer.point(outer.next(s))).squared_distance;
  });
  if (nearest == BoxTree::none) return {};
  const std::int32_t i = front_->station_of[segments[nearest]], j = front_->line.next(i);
  const Point from = front_->points[i], to = front_->points[j];
  const double share = place_on_segment(node, from, to).parameter;
  if (share == 1) return {j};
  return {i, share, share == 0 ? 1 : place_on_segment(node, to, from).parameter};
}

bool FrontPlaces::follows(const FrontPlace& first, const FrontPlace& second) const {
  if (!first.valid() || !second.valid()) return false;
  const WallLine& line = front_->line;
  if (first.station == second.station && first.share < second.share) return true;
  const std::int32_t distance_on = line.steps(first.station, second.station);
  const std::int32_t distance_back = line.steps(second.station, first.station);
  return distance_on != WallLine::none && distance_on != 0 &&
         (distance_back == WallLine::none || distance_on <= distance_back);
}

}  // namespace quadloop
