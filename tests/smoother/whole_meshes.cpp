#include "tests/smoother/whole_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quadloop::test {

const Communicator& self() {
  static const Communicator& held = *new Communicator(MPI_COMM_SELF);
  return held;
}

Mesh jittered(const Grid& grid, double share, std::uint64_t seed) {
  Mesh mesh = grid.mesh();
  jitter(grid, share, seed, mesh);
  return mesh;
}

Mesh tangled(const Grid& grid, std::uint64_t seed) {
  Mesh mesh = jittered(grid, 0.15, seed);
  std::vector<double> shortest(mesh.points.size(), std::numeric_limits<double>::infinity());
  const auto look_at = [&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
      const double edge = length(mesh.point(b) - mesh.point(a));
      for (const NodeId node : {a, b}) shortest[node.value()] = std::min(shortest[node.value()], edge);
    }
  };
  for (const auto& t : mesh.triangles) look_at(t);
  for (const auto& q : mesh.quads) look_at(q);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    if (!grid.inner(node) || scattered(seed, node, 4) > -0.6) continue;
    const double turn = std::numbers::pi * scattered(seed, node, 5),
                 reach = 0.45 * (1 + scattered(seed, node, 6));
    Point& p = mesh.points[node];
    p = p + reach * shortest[node] * Point{std::cos(turn), std::sin(turn)};
  }
  return mesh;
}

Geometry circle(int vertices) {
  std::vector<Boundary> boundaries(1);
  boundaries[0].name = "circle";
  std::vector<Point> points;
  for (int k = 0; k < vertices; ++k)
    points.push_back(
        {std::cos(2 * std::numbers::pi * k / vertices), std::sin(2 * std::numbers::pi * k / vertices)});
  return {boundaries, points, {0, vertices}, std::vector<BoundaryId>(vertices, BoundaryId{0})};
}

namespace {

/// Where the ray at an angle leaves the polygon.
Point on_polygon(const Geometry& polygon, double radians) {
  const double along = polygon.size() * (radians / (2 * std::numbers::pi) + (radians < 0 ? 1 : 0));
  const auto k = static_cast<std::int32_t>(along) % polygon.size();
  return polygon.point(k) + (along - std::floor(along)) * (polygon.point(polygon.next(k)) - polygon.point(k));
}

}  // namespace

Mesh disc(const Grid& grid, const Geometry& polygon) {
  Mesh mesh = grid.mesh();
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point at = grid.place(node), p{2 * at.x - 1, 2 * at.y - 1};
    const Point round{p.x * std::sqrt(1 - p.y * p.y / 2), p.y * std::sqrt(1 - p.x * p.x / 2)};
    const Point by{scattered(5, node, 1), scattered(5, node, 2)};
    const double angle = std::atan2(round.y, round.x) + 0.35 / grid.n * by.x;
    mesh.points[node] = grid.inner(node) ? round + 0.25 / grid.n * by : on_polygon(polygon, angle);
  }
  auto& boundaries = mesh.boundaries;
  boundaries[0].name = "circle";
  boundaries[0].edges.insert(boundaries[0].edges.end(), boundaries[1].edges.begin(),
                             boundaries[1].edges.end());
  boundaries.pop_back();
  return mesh;
}

Mesh smoothed_alone(Mesh mesh, const smoother::SmoothOptions& options, smoother::SmoothReport* report) {
  const smoother::SmoothReport told = smoother::smooth_mesh(self(), mesh, options);
  if (report != nullptr) *report = told;
  return mesh;
}

void expect_same_report(const smoother::SmoothReport& a, const smoother::SmoothReport& b) {
  EXPECT_EQ(a.sweeps, b.sweeps);
  EXPECT_EQ(a.free_nodes, b.free_nodes);
  EXPECT_EQ(a.moves, b.moves);
  EXPECT_EQ(a.worst_cost_before, b.worst_cost_before);
  EXPECT_EQ(a.worst_cost_after, b.worst_cost_after);
  EXPECT_EQ(a.inverted_before, b.inverted_before);
  EXPECT_EQ(a.inverted_after, b.inverted_after);
}

}  // namespace quadloop::test
