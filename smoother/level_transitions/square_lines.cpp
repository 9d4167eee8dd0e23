#include "smoother/level_transitions/square_lines.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::smoother {

namespace {

constexpr double step_into_squares = 0.25;  ///< in edges of the smaller square
/// Relative to that edge: coordinates read from a file are on the grid up to rounding.
constexpr double rounding = 1e-6;
/// A flag besides those of the quadrants: the node is on no level line.
constexpr unsigned unfit = 1U << 8;

/// The direction from the node into the smaller squares, if these lie in two adjacent quadrants.
Point into_squares(unsigned quadrants) {
  switch (quadrants) {
    case 0b0011: return {0, 1};
    case 0b0110: return {-1, 0};
    case 0b1100: return {0, -1};
    case 0b1001: return {1, 0};
    default: return {0, 0};
  }
}

/// Whether two lengths are equal up to rounding, for squares with this edge.
bool near(double a, double b, double edge = 1) { return std::abs(a - b) <= rounding * edge; }

/// The quadrant and edge length of a square with sides along the axes and corners p and `opposite`; `unfit`
/// if the cell is no such square.
struct SquareCorner {
  unsigned quadrant = unfit;
  double edge = 0;
};
SquareCorner square_at(Point p, Point next, Point opposite, Point previous) {
  const Point d = opposite - p;
  const double edge = std::abs(d.x);
  const auto is_side = [&](Point side) {
    const auto [least, most] = std::minmax({std::abs(side.x), std::abs(side.y)});
    return near(most, edge, edge) && near(least, 0, edge);
  };
  if (!(edge > 0) || !near(std::abs(d.y), edge, edge) || !is_side(next - p) || !is_side(previous - p))
    return {};
  if (d.y > 0) return {d.x > 0 ? 0U : 1U, edge};
  return {d.x < 0 ? 2U : 3U, edge};
}

}  // namespace

SquareLines::SquareLines(const HaloMesh& mesh) : mesh_{mesh}, round_(mesh.owned_nodes()) {
  mesh.for_each_cell([&](const auto& nodes) { look_at_squares(nodes); });
  mesh.for_each_cell([&](const auto& nodes) { look_at_triangles(nodes); });
  for (const HaloEdge& edge : mesh.edges_in_place()) {
    for (const NodeId node : {edge.from, edge.to}) exclude(node);
  }
}

Point SquareLines::move_of(NodeId node) const {
  const Surroundings& s = round_[node];
  return -step_into_squares * s.edge * into_squares(s.quadrants);
}

void SquareLines::exclude(NodeId node) {
  if (mesh_.owns(node)) round_[node].quadrants |= unfit;
}

void SquareLines::look_at_squares(const std::array<NodeId, 4>& nodes) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (!mesh_.owns(nodes[k])) continue;
    const SquareCorner square = square_at(mesh_.point(nodes[k]), mesh_.point(nodes[(k + 1) % 4]),
                                          mesh_.point(nodes[(k + 2) % 4]), mesh_.point(nodes[(k + 3) % 4]));
    Surroundings& s = round_[nodes[k]];
    const bool fits =
        square.quadrant != unfit && (s.quadrants == 0 || near(s.edge, square.edge, square.edge));
    s.quadrants |= fits ? 1U << square.quadrant : unfit;
    s.edge = square.edge;
  }
}

/// Checks that the node's triangles reach only points on and behind the line that the division of a larger
/// square has.
void SquareLines::look_at_triangles(const std::array<NodeId, 3>& nodes) {
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

}  // namespace quadloop::smoother
