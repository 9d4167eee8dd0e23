#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Finds the values measured at the ends of wall edges of an earlier mesh near a place of the wall. `Edge`
/// has points `from` and `to`, with the domain to their left.
template <class Edge>
class ValuesAlongWall {
 public:
  explicit ValuesAlongWall(std::span<const Edge> edges) : edges_{edges} {
    std::vector<Box> boxes;
    for (const Edge& edge : edges) boxes.push_back(box_of(edge.from, edge.to));
    tree_ = BoxTree(boxes);
  }

  /// The value at a place of the wall, linear along the nearest edge whose direction is within 90 degrees of
  /// either direction of the wall there; `from` and `to` are the members with the values at its ends. Empty
  /// if the nearest edges run the other way. The reversed mirror image has the same bits.
  std::optional<double> at(Point place, Point before, Point after, double Edge::*from,
                           double Edge::*to) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto distance = [&](std::int32_t k) {
      const Point along = edges_[k].to - edges_[k].from;
      const bool same_way = dot(along, before) > 0 || dot(along, after) > 0;
      return same_way ? place_on_segment(place, edges_[k].from, edges_[k].to).squared_distance : infinite;
    };
    const std::int32_t nearest = tree_.nearest(place, distance);
    if (nearest == BoxTree::none || distance(nearest) == infinite) return {};
    const Edge& edge = edges_[nearest];
    const double on = place_on_segment(place, edge.from, edge.to).parameter,
                 back = place_on_segment(place, edge.to, edge.from).parameter;
    return 0.5 * ((edge.*from + on * (edge.*to - edge.*from)) + (edge.*to + back * (edge.*from - edge.*to)));
  }

 private:
  std::span<const Edge> edges_;
  BoxTree tree_;
};

}  // namespace quadloop
