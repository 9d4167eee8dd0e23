#include "mesher/mesh/check/cell_reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

/// Maximum slope of the quadtree cell sizes: (g - 1) / 2 for the largest gradation g = 2.
constexpr double largest_slope = 0.5;

}  // namespace

void CellReach::build() {
  std::vector<Box> boxes;
  const auto add = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      Box box;
      for (const NodeId node : nodes) box.include(mesh_.point(node));
      boxes.push_back(box);
    }
  };
  add(mesh_.triangles);
  add(mesh_.quads);
  cells_ = BoxTree(boxes);
}

double CellReach::distance_to(std::int32_t cell, Point p) const {
  const std::size_t at = cell;
  const bool triangle = at < mesh_.triangles.size();
  const std::span<const NodeId> nodes =
      triangle ? std::span<const NodeId>(mesh_.triangles[at])
               : std::span<const NodeId>(mesh_.quads[at - mesh_.triangles.size()]);
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Point a = mesh_.point(nodes[k]), b = mesh_.point(nodes[(k + 1) % nodes.size()]);
    inside = inside && cross(b - a, p - a) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? 0 : nearest;
}

/// Returns the maximum of longest edge minus `slope` times distance, over the cells within `distance`; 0 if
/// there are none.
double CellReach::largest_within(Point p, double distance, double slope) const {
  const Box around{{p.x - distance, p.y - distance}, {p.x + distance, p.y + distance}};
  double size = 0;
  cells_.for_each_meeting(around, [&](std::int32_t cell) {
    const double here = longest_[cell];
    if (here <= size) return;
    const double away = distance_to(cell, p);
    if (away <= distance) size = std::max(size, here - slope * away);
  });
  return size;
}

double CellReach::longest_of_nearest(Point p) const {
  const std::int32_t nearest = cells_.nearest_box(p);
  return nearest == BoxTree::none ? 0 : longest_[nearest];
}

double CellReach::size_at(Point p, double enough) {
  constexpr int farthest = 16;
  if (cells_.empty()) build();
  double size = 0;
  for (int times = 1; times <= farthest && size < enough; times *= 2)
    size = largest_within(p, times * enough, largest_slope);
  return size > 0 ? size : longest_of_nearest(p);
}

double CellReach::longest_within(Point p, double distance) {
  if (cells_.empty()) build();
  const double longest = largest_within(p, distance, 0);
  return longest > 0 ? longest : longest_of_nearest(p);
}

}  // namespace quadloop
