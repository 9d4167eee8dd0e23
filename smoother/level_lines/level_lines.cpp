#include "smoother/level_lines/level_lines.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "smoother/level_lines/square_lines.hpp"
#include "smoother/level_lines/triangle_lines.hpp"
#include "smoother/objective/condition_number.hpp"
#include "smoother/objective/cost_limit.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
std::array<Point, width> corners_of(const std::array<NodeId, width>& nodes, const auto& point_of) {
  std::array<Point, width> corners;
  for (std::size_t k = 0; k < width; ++k) corners[k] = point_of(nodes[k]);
  return corners;
}

template <std::size_t width>
double ideal_cost(const std::array<Point, width>& corners) {
  return cell_cost(corners, ideal_targets<width>());
}

/// Copies are moved, too. *Collective.*
void share(HaloMesh& mesh, NodeFlags& moved) {
  mesh.exchange().update(mesh.points());
  mesh.exchange().update(moved);
}

/// Looks at the cells with a node that is flagged as moved. Puts owned nodes of those that have become too
/// bad back, which are then the ones that are flagged. Returns whether there are any over all ranks.
/// *Collective.*
bool take_back(const Communicator& comm, HaloMesh& mesh, const IdVector<NodeId, Point>& before, double limit,
               NodeFlags& moved) {
  std::vector<NodeId> back;
  const CostLimit cost_limit(limit);
  const auto now = [&](NodeId n) { return mesh.point(n); };
  const auto then = [&](NodeId n) { return before[n]; };
  mesh.for_each_cell([&](const auto& nodes) {
    if (!any_flagged(moved, nodes)) return;
    const auto corners = corners_of(nodes, now);
    if (cost_limit.surely_kept_by(corners)) return;
    const double cost = ideal_cost(corners);
    if (cost <= limit || cost <= ideal_cost(corners_of(nodes, then))) return;
    std::ranges::copy_if(nodes, std::back_inserter(back),
                         [&](NodeId n) { return mesh.owns(n) && now(n) != then(n); });
  });
  moved = NodeFlags(moved.size(), 0);
  for (const NodeId node : back) {
    mesh.points()[node.value()] = before[node];
    moved[node] = 1;
  }
  share(mesh, moved);
  return comm.any(!back.empty());
}

/// *Collective.*
template <class Lines>
bool move_lines(const Communicator& comm, HaloMesh& mesh, const Lines& lines, const NodeFlags& pinned,
                double limit) {
  const IdVector<NodeId, Point> before(mesh.points());
  NodeFlags moved(mesh.points().size(), 0);
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (!pinned.empty() && pinned[node] != 0) continue;
    mesh.points()[node.value()] = before[node] + lines.move_of(node);
    moved[node] = mesh.point(node) != before[node] ? 1 : 0;
  }
  if (!comm.any(std::ranges::any_of(moved, [](char flag) { return flag != 0; }))) return false;
  share(mesh, moved);
  while (take_back(comm, mesh, before, limit, moved)) {
  }
  return true;
}

}  // namespace

bool move_square_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& pinned, double limit) {
  return move_lines(comm, mesh, SquareLines(mesh), pinned, limit);
}

bool move_triangle_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& near,
                         const NodeFlags& pinned, double limit) {
  return move_lines(comm, mesh, TriangleLines(mesh, near), pinned, limit);
}

}  // namespace quadloop
