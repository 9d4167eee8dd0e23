// Flows through periodic pairs: what leaves on one side enters on the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/euler/solve_euler.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

/// An irregular grid on a square, its sides "south", "east", "north" and "west" straight, with equal nodes on
/// opposite sides.
Mesh square(std::int32_t n, double side) {
  Mesh mesh = test::irregular_grid(n, {side, side}, 0.15);
  for (std::int32_t i = 0; i <= n; ++i) {
    const auto at = [&](std::int32_t column, std::int32_t row) -> Point& {
      return mesh.points[row * (n + 1) + column];
    };
    at(i, n) = {at(i, 0).x, side};
    at(n, i) = {side, at(0, i).y};
  }
  const double edge = 0.25 * side / n;
  test::relabel(mesh, [&](Point p) {
    return p.y < edge ? "south" : p.y > side - edge ? "north" : p.x < edge ? "west" : "east";
  });
  return mesh;
}

/// The square with pairs in both directions.
Mesh torus(std::int32_t n, double side) {
  Mesh mesh = square(n, side);
  mesh.pairs = {{"west", "east", {side, 0}}, {"south", "north", {0, side}}};
  return mesh;
}

/// Half of a ring, from the radius 1 to 2: `along` the positive x axis, turned by 180 degrees onto `back`.
Mesh half_ring(std::int32_t n) {
  Mesh mesh = square(n, 1);
  for (Point& p : mesh.points) {
    const double angle = std::numbers::pi * p.y, radius = 1 + p.x;
    p = p.y == 1 ? Point{-radius, 0} : Point{radius * std::cos(angle), radius * std::sin(angle)};
  }
  mesh.pairs = {{"south", "north", {}, 180, {}}};
  return mesh;
}

Mesh part_of(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

EulerOptions in_time(double mach, double alpha, double end) {
  EulerOptions options;
  options.mach = mach;
  options.alpha = alpha;
  options.time = EulerOptions::Time::accurate;
  options.end_time = end;
  return options;
}

/// Largest difference of any variable from the first row.
double unevenness(const Field& flow) {
  double largest = 0;
  for (std::size_t i = 0; i < flow.values.size(); ++i)
    largest = std::max(largest, std::abs(flow.values[i] - flow.values[i % flow.width()]));
  return world().maximum(largest);
}

TEST(Pairs, AUniformFlowStaysUniform) {
  const Mesh mesh = part_of(torus(9, 1));
  for (const double viscosity : {0.0, 1e-2}) {
    EulerOptions options = in_time(0.6, 20, 0.3);
    options.viscosity = viscosity;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
    options.time_step = 0.05;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
    options.time_step = {};
    options.time = EulerOptions::Time::steady;
    options.iterations = 5;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
  }
}

/// Root mean square error of the density after a vortex has crossed the box once, relative to the vortex:
/// 1 if it is lost.
double error_after_a_period(std::int32_t n) {
  const double side = 10, mach = 1;
  const Mesh mesh = part_of(torus(n, side));
  EulerOptions options = in_time(mach, 0, side / mach);
  options.initial = EulerOptions::Initial::vortex;
  options.vortex_centre = Point{5, 5};
  const EulerResult result = solve_euler(world(), mesh, options);
  const euler::Gas gas;
  const euler::Vortex exact{gas, gas.free_stream(mach, 0), *options.vortex_centre, 1};
  std::vector<double> errors, vortex;
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double density = exact.state(mesh.point(NodeId{node}), 0)[0],
                 error = result.flow.values[4 * node] - density;
    errors.push_back(error * error);
    vortex.push_back((1 - density) * (1 - density));
  }
  const double lost = reproducible_sum(world(), vortex);
  return std::sqrt(reproducible_sum(world(), errors) / lost);
}

TEST(Pairs, AVortexLeavesAndReturns) {
  const double coarse = error_after_a_period(16), fine = error_after_a_period(32);
  EXPECT_LT(fine, 0.5);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(Pairs, PartnersHaveTheSameState) {
  const std::int32_t n = 12;
  const Mesh whole = torus(n, 10);
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  EulerOptions options = in_time(0.5, 30, 6);
  options.initial = EulerOptions::Initial::vortex;
  options.vortex_centre = Point{9, 9};
  const Field flow = gather_field(world(), solve_euler(world(), mesh, options).flow, mesh, own_order(whole));
  if (!world().is_root()) return;
  const auto row = [&](std::int32_t i, std::int32_t j) { return flow.row(NodeId{j * (n + 1) + i}); };
  EXPECT_FALSE(std::ranges::equal(row(0, 0), row(1, 1)));
  for (std::int32_t i = 0; i <= n; ++i) {
    EXPECT_TRUE(std::ranges::equal(row(i, 0), row(i, n))) << i;
    EXPECT_TRUE(std::ranges::equal(row(0, i), row(n, i))) << i;
  }
}

/// Two runs, on all ranks and alone, must agree to the last bit.
void expect_same_on_all_ranks(const Mesh& whole, const EulerOptions& options) {
  const MeshOrder order = test::shuffled_order(whole, 5);
  const Communicator self(MPI_COMM_SELF);
  const Mesh part = scatter_mesh(world(), whole, order);
  const EulerResult together = solve_euler(world(), part, options),
                    alone = solve_euler(self, scatter_mesh(self, whole, order), options);
  const auto first = alone.flow.values.begin() + static_cast<std::ptrdiff_t>(4 * part.first_node);
  EXPECT_TRUE(std::equal(together.flow.values.begin(), together.flow.values.end(), first));
  EXPECT_EQ(together.residual, alone.residual);
}

TEST(Pairs, RanksGiveTheSameBits) {
  EulerOptions options = in_time(0.5, 30, 1);
  options.initial = EulerOptions::Initial::vortex;
  options.boundaries = {{"west", "wall", {}}, {"east", "wall", {}}};
  for (const Mesh& whole : {torus(9, 5), torus(2, 5), torus(1, 5)}) {
    expect_same_on_all_ranks(whole, options);
    EulerOptions implicit = options;
    implicit.time_step = 0.2;
    expect_same_on_all_ranks(whole, implicit);
  }
  options.mach = 0.2;
  expect_same_on_all_ranks(half_ring(8), options);
  options.time = EulerOptions::Time::steady;
  options.iterations = 12;
  expect_same_on_all_ranks(half_ring(8), options);
  expect_same_on_all_ranks(torus(9, 5), options);
}

EulerOptions between_walls(double mach, double end) {
  EulerOptions options = in_time(mach, 0, end);
  options.boundaries = {{"west", "wall", {}}, {"east", "wall", {}}};
  return options;
}

TEST(Pairs, GasAtRestInHalfARingStaysAtRest) {
  EXPECT_LT(unevenness(solve_euler(world(), part_of(half_ring(8)), between_walls(0, 0.5)).flow), 1e-13);
}

/// Largest change of a steady flow after some time: of a swirl with velocity w r and the pressure
/// p = rho w^2 r^2 / 2 + constant.
double change_of_swirl(std::int32_t n) {
  const Mesh mesh = part_of(half_ring(n));
  const double w = 0.2;
  Field start;
  start.names = {"density", "x_velocity", "y_velocity", "pressure"};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point p = mesh.point(NodeId{node});
    start.values.insert(start.values.end(), {1, -w * p.y, w * p.x, 1 / 1.4 + 0.5 * w * w * (dot(p, p) - 1)});
  }
  const EulerResult result = solve_euler(world(), mesh, between_walls(0, 0.5), start);
  double largest = 0;
  for (std::size_t i = 0; i < start.values.size(); ++i)
    largest = std::max(largest, std::abs(result.flow.values[i] - start.values[i]));
  return world().maximum(largest);
}

TEST(Pairs, VelocitiesTurnWithARotation) {
  const double coarse = change_of_swirl(16), fine = change_of_swirl(32);
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(Pairs, WhatIsNotSupportedIsRefused) {
  const Mesh ring = part_of(half_ring(4)), box = part_of(torus(4, 1));
  EulerOptions options = in_time(0.5, 0, 0.1);
  options.boundaries = {{"west", "farfield", {}}, {"east", "wall", {}}};
  EXPECT_THROW(solve_euler(world(), ring, options), InputError);
  options.mach = 0;
  EXPECT_NO_THROW(solve_euler(world(), ring, options));
  options.far_field = EulerOptions::FarField::vortex;
  EXPECT_THROW(solve_euler(world(), box, options), InputError);
}

}  // namespace
}  // namespace quadloop::flow
