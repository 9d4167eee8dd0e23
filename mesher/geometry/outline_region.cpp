#include "mesher/geometry/outline_region.hpp"

#include <algorithm>
#include <limits>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

std::vector<std::pair<Point, Point>> edges_of_block(const Geometry& geometry, std::int32_t block) {
  std::vector<std::pair<Point, Point>> edges;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (geometry.block_of(s) == block)
      edges.emplace_back(geometry.point(s), geometry.point(geometry.next(s)));
  }
  return edges;
}

bool edge_meets(const std::pair<Point, Point>& edge, const Box& box) {
  const auto& [from, to] = edge;
  if (box.contains(from) || box.contains(to)) return true;
  const Point other_low{box.high.x, box.low.y}, other_high{box.low.x, box.high.y};
  return segments_meet(from, to, box.low, box.high) || segments_meet(from, to, other_low, other_high);
}

}  // namespace

OutlineRegion::OutlineRegion(std::vector<std::pair<Point, Point>> edges)
    : edges_{std::move(edges)},
      tree_(size32(edges_), [&](std::int32_t e) { return box_of(edges_[e].first, edges_[e].second); }) {
  for (const auto& [from, to] : edges_) {
    box_.include(from);
    box_.include(to);
  }
}

OutlineRegion::OutlineRegion(const Geometry& geometry, std::int32_t block)
    : OutlineRegion(edges_of_block(geometry, block)) {}

bool OutlineRegion::meets(const Box& box) const {
  if (!box_.meets(box)) return false;
  return tree_.any_meeting(box, [&](std::int32_t e) { return edge_meets(edges_[e], box); }) ||
         contains(box.centre());
}

/// For a point on no edge: an exact count of the edges that a ray to the left crosses.
bool OutlineRegion::contains(Point p) const {
  bool odd = false;
  tree_.for_each_meeting({{-std::numeric_limits<double>::infinity(), p.y}, p}, [&](std::int32_t e) {
    auto [low, high] = edges_[e];
    if ((low.y > p.y) == (high.y > p.y)) return;
    if (low.y > high.y) std::swap(low, high);
    odd = odd != (orientation(low, high, p) < 0);
  });
  return odd;
}

}  // namespace quadloop
