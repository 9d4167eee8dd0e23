// Laminar flows that are known: Blasius' plate, heat through gas at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/euler/solve_euler.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

/// Quads between these lines of equal x and of equal y; the boundaries' names are those of their middles.
Mesh mesh_of_lines(const std::vector<double>& xs, const std::vector<double>& ys,
                   const std::function<std::string(Point)>& name_of) {
  const auto across = static_cast<std::int32_t>(xs.size()), up = static_cast<std::int32_t>(ys.size());
  const auto at = [&](std::int32_t i, std::int32_t j) { return NodeId{j * across + i}; };
  Mesh mesh;
  mesh.owned_nodes = across * up;
  for (const double y : ys) {
    for (const double x : xs) mesh.points.push_back({x, y});
  }
  BoundaryEdges sides;
  for (std::int32_t j = 0; j + 1 < up; ++j) {
    for (std::int32_t i = 0; i + 1 < across; ++i)
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    sides.edges.push_back({at(across - 1, j), at(across - 1, j + 1)});
    sides.edges.push_back({at(0, j + 1), at(0, j)});
  }
  for (std::int32_t i = 0; i + 1 < across; ++i) {
    sides.edges.push_back({at(i, 0), at(i + 1, 0)});
    sides.edges.push_back({at(i + 1, up - 1), at(i, up - 1)});
  }
  mesh.boundaries = {sides};
  test::relabel(mesh, name_of);
  return mesh;
}

/// From 0 in steps that grow.
std::vector<double> growing(double first, double growth, int count) {
  std::vector<double> places{0};
  for (int k = 0; k < count; ++k, first *= growth) places.push_back(places.back() + first);
  return places;
}

TEST(FlatPlate, HasBlasiusFriction) {
  std::vector<double> xs;
  const std::vector<double> ahead = growing(0.003, 1.25, 17), along = growing(0.003, 1.08, 43);
  for (std::size_t k = ahead.size(); k-- > 1;) xs.push_back(-ahead[k]);
  xs.insert(xs.end(), along.begin(), along.end());
  const Mesh mesh = mesh_of_lines(xs, growing(0.0002, 1.2, 38), [&](Point p) {
    if (p.y == 0) return p.x < 0 ? "symmetry" : "wall";
    return p.x == xs.back() ? "outflow" : "farfield";
  });
  constexpr double reynolds = 1e5;  // per length
  EulerOptions options;
  options.mach = 0.2;
  options.viscosity = options.mach / reynolds;
  options.limiter = EulerOptions::Limiter::none;
  options.tolerance = 1e-5;
  options.boundaries = {{"outflow", {}, 1.0}};
  const EulerResult result = solve_euler(world(), mesh, options);
  EXPECT_TRUE(result.converged) << result.residual;
  ASSERT_EQ(result.flow.width(), 5u);
  int compared = 0;
  double drag = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (xs[i] < 0) continue;
    const auto row = result.flow.row(NodeId{static_cast<std::int32_t>(i)});
    EXPECT_EQ(row[1], 0);
    EXPECT_EQ(row[2], 0);
    const double width = 0.5 * ((i + 1 < xs.size() ? xs[i + 1] : xs[i]) - std::max(0.0, xs[i - 1]));
    drag += width * row[4] / (0.5 * options.mach * options.mach);
    if (xs[i] < 0.1 || xs[i] > 0.8) continue;
    const double friction = row[4] / (0.5 * options.mach * options.mach);
    EXPECT_NEAR(friction * std::sqrt(reynolds * xs[i]) / 0.664, 1, 0.02) << xs[i];
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_NEAR(result.cd_friction, drag, 0.02 * drag);
  EXPECT_NEAR(result.cd, result.cd_friction, 1e-6);
}

TEST(GasAtRest, ConductsHeatFromWallToWall) {
  const Mesh mesh = mesh_of_lines(growing(0.2, 1, 5), growing(0.002, 1.3, 8), [](Point p) {
    return p.y == 0 ? "cold" : p.x == 0 || std::abs(p.x - 1) < 1e-12 ? "symmetry" : "warm";
  });
  EulerOptions options;
  options.mach = 0;
  options.viscosity = 0.01;
  options.iterations = 400;
  options.tolerance = 1e-10;
  options.boundaries = {{"cold", "wall", {}, 0.9}, {"warm", "wall", {}, 1.2}};
  const EulerResult result = solve_euler(world(), mesh, options);
  EXPECT_TRUE(result.converged) << result.residual;
  const double height = mesh.points.back().y;
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const auto row = result.flow.row(NodeId{node});
    EXPECT_NEAR(1.4 * row[3] / row[0], 0.9 + 0.3 * mesh.points[node].y / height, 1e-5);
    EXPECT_NEAR(row[2], 0, 1e-5);  // the little that the entropy fix carries along the density's gradient
  }
}

}  // namespace
}  // namespace quadloop::flow
