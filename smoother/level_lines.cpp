#include "smoother/level_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "smoother/objective/condition_number.hpp"

namespace quadloop {

namespace {

constexpr double step = 0.25;  ///< of the smaller square's edge
/// Of that edge: coordinates that went through a file are on the lattice nearly.
constexpr double rounding = 1e-6;
/// A flag beside those of the quadrants: the node's cells are not those of a level line.
constexpr unsigned unfit = 1U << 8;

/// What lies round a node: bit k of `quadrants` stands for a square in quadrant k (0: right and up, then
/// counter-clockwise).
struct Surroundings {
  double edge = 0;  ///< of the squares
  unsigned quadrants = 0;
  unsigned line_ends = 0;  ///< bit 0, 1: triangles reach the node's neighbour on the line, on either side
};

/// From the node into the smaller squares, where they lie in two quadrants side by side.
Point into_squares(unsigned quadrants) {
  switch (quadrants) {
    case 0b0011: return {0, 1};
    case 0b0110: return {-1, 0};
    case 0b1100: return {0, -1};
    case 0b1001: return {1, 0};
    default: return {0, 0};
  }
}

bool near(double a, double b) { return std::abs(a - b) <= rounding; }

/// The quadrant in which a square lies with `opposite` its far corner from p, if it is a square with its
/// sides along the axes, and its edge.
struct SquareCorner {
  unsigned quadrant = unfit;
  double edge = 0;
};
SquareCorner square_at(Point p, Point next, Point opposite, Point previous) {
  const Point u = next - p, v = previous - p, d = opposite - p;
  const double edge = std::abs(d.x);
  const bool along_axes = edge > 0 && near(std::abs(d.y) / edge, 1) && near(length(u) / edge, 1) &&
                          near(length(v) / edge, 1) &&
                          near(std::min(std::abs(u.x), std::abs(u.y)) / edge, 0) &&
                          near(std::min(std::abs(v.x), std::abs(v.y)) / edge, 0);
  if (!along_axes) return {};
  if (d.y > 0) return {d.x > 0 ? 0U : 1U, edge};
  return {d.x < 0 ? 2U : 3U, edge};
}

/// Finds the nodes of level lines among those that this rank owns.
class LevelLines {
 public:
  explicit LevelLines(const HaloMesh& mesh) : mesh_{mesh}, round_(mesh.owned_nodes()) {
    mesh.for_each_cell([&](const auto& nodes) { look_at_squares(nodes); });
    mesh.for_each_cell([&](const auto& nodes) { look_at_triangles(nodes); });
    for (const HaloEdge& edge : mesh.boundary_edges()) {
      for (const NodeId node : {edge.from, edge.to}) exclude(node);
    }
  }

  /// Where an owned node goes; nowhere if it is of no level line.
  Point move_of(NodeId node) const {
    const Surroundings& s = round_[node];
    if (s.line_ends != 0b11) return {};
    return -step * s.edge * into_squares(s.quadrants);
  }

 private:
  void exclude(NodeId node) {
    if (mesh_.owns(node)) round_[node].quadrants |= unfit;
  }

  void look_at_squares(const std::array<NodeId, 4>& nodes) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (!mesh_.owns(nodes[k])) continue;
      const SquareCorner square = square_at(mesh_.point(nodes[k]), mesh_.point(nodes[(k + 1) % 4]),
                                            mesh_.point(nodes[(k + 2) % 4]), mesh_.point(nodes[(k + 3) % 4]));
      Surroundings& s = round_[nodes[k]];
      const bool fits = square.quadrant != unfit && (s.quadrants == 0 || near(s.edge / square.edge, 1));
      s.quadrants |= fits ? 1U << square.quadrant : unfit;
      s.edge = square.edge;
    }
  }
  void look_at_squares(const std::array<NodeId, 3>&) {}

  /// The node's triangles reach the points that the division of a larger square has on and behind the line,
  /// and no others.
  void look_at_triangles(const std::array<NodeId, 3>& nodes) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!mesh_.owns(nodes[k])) continue;
      Surroundings& s = round_[nodes[k]];
      const Point into = into_squares(s.quadrants);
      if (into == Point{0, 0}) continue;
      for (const NodeId other : {nodes[(k + 1) % 3], nodes[(k + 2) % 3]}) {
        const Point d = (1 / s.edge) * (mesh_.point(other) - mesh_.point(nodes[k]));
        const double behind = -dot(d, into), along = cross(into, d);
        const bool beside = near(std::abs(along), 1);
        const bool on_line = beside && near(behind, 0), opposite = near(along, 0) && near(behind, 2);
        const bool at_corner = beside && (near(behind, 1) || near(behind, 2));
        if (on_line) s.line_ends |= along > 0 ? 1U : 2U;
        if (!on_line && !opposite && !at_corner) s.quadrants |= unfit;
      }
    }
  }
  void look_at_triangles(const std::array<NodeId, 4>&) {}

  const HaloMesh& mesh_;
  IdVector<NodeId, Surroundings> round_;
};

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

}  // namespace

bool move_level_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& pinned, double limit) {
  const LevelLines lines(mesh);
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

}  // namespace quadloop
