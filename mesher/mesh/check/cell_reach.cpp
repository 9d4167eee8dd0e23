#include "mesher/mesh/check/cell_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop {

namespace {

/// Maximum slope of the quadtree cell sizes: (g - 1) / 2 for the largest gradation g = 2.
constexpr double largest_slope = 0.5;

double squared_distance_to(const Box& box, Point p) {
  const Point away{std::max({box.low.x - p.x, 0.0, p.x - box.high.x}),
                   std::max({box.low.y - p.y, 0.0, p.y - box.high.y})};
  return dot(away, away);
}

/// The answer from one rank's cells.
struct ReachAnswer {
  double size = 0;
  CellReach::Nearest nearest = {};

  void include(const ReachAnswer& other) {
    size = std::max(size, other.size);
    const CellReach::Nearest &here = nearest, &there = other.nearest;
    if (std::pair(there.squared_distance, there.cell) < std::pair(here.squared_distance, here.cell))
      nearest = other.nearest;
  }
};

}  // namespace

void CellReach::build() {
  cells_ = BoxTree(static_cast<std::int32_t>(mesh_.cell_count()),
                   [&](std::int32_t cell) { return box_of_cell(cell); });
}

std::span<const NodeId> CellReach::nodes_of(std::int32_t cell) const {
  const std::size_t at = cell, triangles = mesh_.triangles.size();
  return at < triangles ? std::span<const NodeId>(mesh_.triangles[at])
                        : std::span<const NodeId>(mesh_.quads[at - triangles]);
}

Box CellReach::box_of_cell(std::int32_t cell) const {
  Box box;
  for (const NodeId node : nodes_of(cell)) box.include(mesh_.point(node));
  return box;
}

double CellReach::distance_to(std::int32_t cell, Point p) const {
  const std::span<const NodeId> nodes = nodes_of(cell);
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

CellReach::Nearest CellReach::nearest(Point p) {
  if (cells_.empty()) build();
  const std::int32_t cell = cells_.nearest_box(p);
  if (cell == BoxTree::none) return {};
  return {squared_distance_to(box_of_cell(cell), p), cell, longest_[cell]};
}

double CellReach::size_at(Point p, double enough) {
  constexpr int farthest = 16;
  if (cells_.empty()) build();
  double size = 0;
  for (int times = 1; times <= farthest && size < enough; times *= 2)
    size = largest_within(p, times * enough, largest_slope);
  return size;
}

double CellReach::longest_within(Point p, double distance) {
  if (cells_.empty()) build();
  return largest_within(p, distance, 0);
}

std::vector<double> answers_over(const Communicator& comm, const Mesh& mesh,
                                 const std::vector<double>& longest, std::vector<ReachQuestion> questions) {
  comm.broadcast(questions);
  if (questions.empty()) return {};
  const CellOwners owners(comm, mesh);
  CellReach reach(mesh, longest);
  std::vector<ReachAnswer> own;
  for (const auto& [place, distance, is_size] : questions) {
    ReachAnswer& answer = own.emplace_back(
        ReachAnswer{is_size ? reach.size_at(place, distance) : reach.longest_within(place, distance)});
    if (answer.size == 0) answer.nearest = reach.nearest(place);
    if (answer.nearest.cell >= 0) answer.nearest.cell = owners.number(answer.nearest.cell);
  }
  const std::vector<ReachAnswer> all = gather_at_root(comm, own);
  std::vector<double> answers;
  for (std::size_t i = 0; comm.is_root() && i < questions.size(); ++i) {
    ReachAnswer answer = all[i];
    for (std::size_t k = i + questions.size(); k < all.size(); k += questions.size()) answer.include(all[k]);
    answers.push_back(answer.size > 0 ? answer.size : answer.nearest.longest);
  }
  return answers;
}

}  // namespace quadloop
