#include "mesher/mesh/cell_reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

namespace quadloop {

namespace bgi = boost::geometry::index;

namespace {

constexpr double largest_slope = 0.5;  ///< of the leaves' sizes: (g - 1) / 2 for the largest gradation g = 2

}  // namespace

double distance_to_segment(Point p, Point a, Point b) {
  const Point edge = b - a;
  const double squared = dot(edge, edge);
  const double t = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return length(p - a - t * edge);
}

void CellReach::build() {
  std::vector<Entry> entries;
  const auto add = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      Box box;
      for (const NodeId node : nodes) box.include(mesh_.point(node));
      entries.emplace_back(IndexBox{{box.low.x, box.low.y}, {box.high.x, box.high.y}},
                           static_cast<std::int32_t>(entries.size()));
    }
  };
  add(mesh_.triangles);
  add(mesh_.quads);
  cells_ = decltype(cells_)(entries);
}

double CellReach::distance_to(std::int32_t cell, Point p) const {
  const auto at = static_cast<std::size_t>(cell);
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

/// The largest of longest edge less `slope` times the distance, over the cells within `distance`; 0 where
/// there are none.
double CellReach::largest_within(Point p, double distance, double slope) const {
  const IndexBox around{{p.x - distance, p.y - distance}, {p.x + distance, p.y + distance}};
  double size = 0;
  for (auto found = cells_.qbegin(bgi::intersects(around)); found != cells_.qend(); ++found) {
    const double here = longest_[static_cast<std::size_t>(found->second)];
    if (here <= size) continue;
    const double away = distance_to(found->second, p);
    if (away <= distance) size = std::max(size, here - slope * away);
  }
  return size;
}

double CellReach::longest_of_nearest(Point p) const {
  const auto nearest = cells_.qbegin(bgi::nearest(IndexPoint(p.x, p.y), 1));
  return nearest == cells_.qend() ? 0 : longest_[static_cast<std::size_t>(nearest->second)];
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
