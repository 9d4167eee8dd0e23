#include "smoother/level_lines/level_lines.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>
#include <type_traits>

#include "smoother/level_lines/square_lines.hpp"
#include "smoother/level_lines/triangle_lines.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop {

namespace {

double ideal_cost(const auto& nodes, const auto& point_of) {
  constexpr std::size_t width = std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>>;
  std::array<Point, width> corners;
  for (std::size_t k = 0; k < width; ++k) corners[k] = point_of(nodes[k]);
  return cell_cost(corners, ideal_targets<width>());
}

/// Puts owned nodes of cells that have become too bad back. Returns whether there are any over all ranks.
/// *Collective.*
bool take_back(const Communicator& comm, HaloMesh& mesh, const IdVector<NodeId, Point>& before,
               double limit) {
  std::vector<NodeId> back;
  const auto now = [&](NodeId n) { return mesh.point(n); };
  const auto then = [&](NodeId n) { return before[n]; };
  const auto has_moved = [&](NodeId n) { return now(n) != then(n); };
  mesh.for_each_cell([&](const auto& nodes) {
    if (std::none_of(nodes.begin(), nodes.end(), has_moved)) return;
    const double cost = ideal_cost(nodes, now);
    if (cost <= limit || cost <= ideal_cost(nodes, then)) return;
    std::ranges::copy_if(nodes, std::back_inserter(back), [&](NodeId n) { return mesh.owns(n); });
  });
  for (const NodeId node : back) mesh.points()[node.value()] = before[node];
  mesh.exchange().update(mesh.points());
  return comm.any(!back.empty());
}

/// *Collective.*
template <class Lines>
bool move_lines(const Communicator& comm, HaloMesh& mesh, const Lines& lines, const NodeFlags& pinned, double limit) {
  const IdVector<NodeId, Point> before(mesh.points());
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (pinned.empty() || pinned[node] == 0) mesh.points()[node.value()] = before[node] + lines.move_of(node);
  }
  if (!comm.any(!std::ranges::equal(mesh.points(), before))) return false;
  mesh.exchange().update(mesh.points());
  while (take_back(comm, mesh, before, limit)) {
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
