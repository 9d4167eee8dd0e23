#include "smoother/level_transitions/level_transitions.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <utility>
#include <vector>

#include "mesher/geometry/blunt_corners.hpp"
#include "smoother/level_transitions/square_lines.hpp"
#include "smoother/level_transitions/triangle_lines.hpp"
#include "smoother/objective/condition_number.hpp"
#include "smoother/objective/cost_limit.hpp"

namespace quadloop::smoother {

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

/// Updates ghost copies of the nodes and of the flags. *Collective.*
void share(HaloMesh& mesh, NodeFlags& moved) {
  mesh.update_points();
  mesh.exchange().update(moved);
}

/// The result of moving lines.
struct Lines {
  NodeFlags moved;     ///< nodes whose cells have to be checked
  NodeFlags doubtful;  ///< nodes of triangles with edges that may not be Delaunay
};

/// Flags the moved nodes of a triangle that is neither acute nor half a square. In other triangles the edges
/// opposite the angles are Delaunay.
void doubt(const std::array<NodeId, 3>& nodes, const std::array<Point, 3>& p, const NodeFlags& moved,
           NodeFlags& doubtful) {
  for (unsigned blunt = blunt_corners(p[0], p[1], p[2]); blunt != 0; blunt &= blunt - 1) {
    const int k = std::countr_zero(blunt);
    if (is_right_along_axes(p[(k + 2) % 3], p[k], p[(k + 1) % 3])) continue;
    for (const NodeId node : nodes) doubtful[node] |= moved[node];
  }
}
void doubt(const std::array<NodeId, 4>&, const std::array<Point, 4>&, const NodeFlags&, NodeFlags&) {}

/// Checks the cells with a node flagged as moved. Moves the owned nodes of cells that have become too bad
/// back; only these stay flagged. Returns whether there are any on any rank. *Collective.*
bool take_back(const Communicator& comm, HaloMesh& mesh, const IdVector<NodeId, Point>& before, double limit,
               Lines& lines) {
  std::vector<NodeId> back;
  const CostLimit cost_limit(limit);
  const auto now = [&](NodeId n) { return mesh.point(n); };
  const auto then = [&](NodeId n) { return before[n]; };
  mesh.for_each_cell([&](const auto& nodes) {
    if (!any_flagged(lines.moved, nodes)) return;
    const auto corners = corners_of(nodes, now);
    doubt(nodes, corners, lines.moved, lines.doubtful);
    if (cost_limit.surely_kept_by(corners)) return;
    const double cost = ideal_cost(corners);
    if (cost <= limit || cost <= ideal_cost(corners_of(nodes, then))) return;
    std::ranges::copy_if(nodes, std::back_inserter(back),
                         [&](NodeId n) { return mesh.owns(n) && now(n) != then(n); });
  });
  lines.moved = NodeFlags(lines.moved.size(), 0);
  for (const NodeId node : back) {
    mesh.points()[node.value()] = before[node];
    lines.moved[node] = 1;
  }
  share(mesh, lines.moved);
  return comm.any(!back.empty());
}

struct NodeMove {
  NodeId node;
  Point by;
};

/// The moves of nodes that are not pinned.
template <class Finder>
std::vector<NodeMove> moves_of(const Finder& finder, const NodeFlags& pinned) {
  std::vector<NodeMove> moves;
  finder.for_each_move([&](NodeId node, Point move) {
    if (pinned.empty() || pinned[node] == 0) moves.push_back({node, move});
  });
  return moves;
}

/// Returns the nodes at possibly non-Delaunay edges; empty if nothing has moved. *Collective.*
NodeFlags move_lines(const Communicator& comm, HaloMesh& mesh, const std::vector<NodeMove>& moves,
                     double limit) {
  if (!comm.any(!moves.empty())) return {};
  const IdVector<NodeId, Point> before(mesh.points());
  Lines lines{NodeFlags(before.size(), 0), NodeFlags(before.size(), 0)};
  for (const auto& [node, by] : moves) {
    mesh.points()[node.value()] = before[node] + by;
    lines.moved[node] = mesh.point(node) != before[node] ? 1 : 0;
  }
  if (!comm.any(std::ranges::find(lines.moved, 1) != lines.moved.end())) return {};
  share(mesh, lines.moved);
  while (take_back(comm, mesh, before, limit, lines)) {
  }
  mesh.exchange().update(lines.doubtful);
  return std::move(lines.doubtful);
}

}  // namespace

bool move_square_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& pinned, double limit) {
  return !move_lines(comm, mesh, moves_of(SquareLines(mesh), pinned), limit).empty();
}

NodeFlags move_triangle_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& near,
                              const NodeFlags& pinned, double limit) {
  return move_lines(comm, mesh, moves_of(TriangleLines(mesh, near), pinned), limit);
}

}  // namespace quadloop::smoother
