// Flows whose answer is known; euler_ranks_test looks at numbers of ranks.
#include "flow/euler/solve_euler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

/// The largest difference between any node's state and the free stream.
double departure(const EulerResult& result, const EulerOptions& options) {
  const double angle = options.alpha * std::acos(-1.0) / 180;
  const std::array<double, 4> uniform{1, options.mach * std::cos(angle), options.mach * std::sin(angle),
                                      1 / options.gamma};
  double largest = 0;
  for (std::size_t i = 0; i < result.flow.values.size(); ++i)
    largest = std::max(largest, std::abs(result.flow.values[i] - uniform[i % 4]));
  return world().maximum(largest);
}

Mesh shared(const Mesh& whole) { return scatter_mesh(world(), whole, space_filling_order(whole)); }

/// Starts a little off the free stream where asked to.
Field disturbed(const Mesh& mesh, const EulerOptions& options, double by) {
  const double angle = options.alpha * std::acos(-1.0) / 180;
  Field start{{"rho", "u", "v", "p"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double more = 1 + by * test::scattered(2, mesh.first_node + node, 0);
    start.values.insert(start.values.end(), {more, options.mach * std::cos(angle),
                                             options.mach * std::sin(angle), more / options.gamma});
  }
  return start;
}

TEST(UniformFlow, IsKeptAndComesBack) {
  Mesh whole = test::irregular_grid(12, {2, 1}, 0.2);
  test::relabel(whole, [](Point) { return "farfield"; });
  const Mesh mesh = shared(whole);
  EulerOptions options;
  for (const double mach : {0.3, 0.95, 2.0}) {
    options.mach = mach;
    options.alpha = 12;
    options.tolerance = 0;
    options.iterations = 20;
    EXPECT_LT(departure(solve_euler(world(), mesh, options), options), 1e-12);
    options.time = EulerOptions::Time::accurate;
    EXPECT_LT(departure(solve_euler(world(), mesh, options), options), 1e-12);
    options.time = EulerOptions::Time::steady;
    options.tolerance = 1e-10;
    options.iterations = 300;
    const EulerResult back = solve_euler(world(), mesh, options, disturbed(mesh, options, 0.05));
    EXPECT_TRUE(back.converged);
    EXPECT_LT(departure(back, options), 1e-8);
  }
}

TEST(UniformFlow, IsKeptBetweenWalls) {
  Mesh whole = test::irregular_grid(12, {2, 1}, 0.2);
  test::relabel(whole, [](Point p) {
    return p.y == 0 ? "symmetry" : p.y == 1 ? "wall" : p.x == 0 ? "inflow" : "outflow";
  });
  const Mesh mesh = shared(whole);
  EulerOptions options;
  options.alpha = 0;
  options.tolerance = 0;
  options.iterations = 20;
  for (const double mach : {0.3, 2.0}) {
    options.mach = mach;
    if (mach < 1) options.boundaries = {{"outflow", {}, 1.0}};
    const EulerResult result = solve_euler(world(), mesh, options);
    EXPECT_LT(departure(result, options), 1e-12);
    EXPECT_NEAR(result.cl, 0, 1e-10);
  }
}

/// An airfoil some 12 % thick (Karman and Trefftz 1918) with its trailing edge at a node, in a ring of cells
/// that reaches so many chords out.
Mesh airfoil_mesh(std::int32_t outwards, double far) {
  constexpr double sharpness = 1.85;  // of the trailing edge, 2 for a cusp
  constexpr double offset = 0.1;      // of the middle of the circle that becomes the airfoil
  Mesh mesh = test::ring_mesh(64, outwards, 1, 2 * far);
  for (Point& point : mesh.points) {
    const std::complex<double> z =
        2 * (1 + offset) * std::complex<double>{point.x, point.y} - std::complex<double>{offset, 0};
    const std::complex<double> power = std::pow((z - 1.0) / (z + 1.0), sharpness);
    const std::complex<double> w = 0.25 * sharpness * (1.0 + power) / (1.0 - power);
    point = {w.real(), w.imag()};
  }
  return mesh;
}

/// Thin cold gas that goes to and fro from node to node at sixty times the speed of sound.
TEST(SteadyFlow, LeavesAStartThatLeadsNowhereForTheFreeStream) {
  const Mesh mesh = shared(airfoil_mesh(24, 10));
  EulerOptions options;
  options.mach = 0.3;
  options.iterations = 300;
  Field start{{"density", "x_velocity", "y_velocity", "pressure"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double speed = (mesh.first_node + node) % 2 == 0 ? 20 : -20;
    start.values.insert(start.values.end(), {1, speed, 0, 1e-4});
  }
  const EulerResult cold = solve_euler(world(), mesh, options),
                    transferred = solve_euler(world(), mesh, options, start),
                    gone_on = solve_euler(world(), mesh, options, cold.flow);
  EXPECT_TRUE(transferred.converged);
  EXPECT_GT(transferred.left_start, 0);
  EXPECT_EQ(transferred.iterations, transferred.left_start + cold.iterations);
  EXPECT_EQ(transferred.flow.values, cold.flow.values);
  EXPECT_EQ(gone_on.left_start, 0);
}

TEST(SteadyFlow, LiftHardlyDependsOnHowFarAFarFieldWithAVortexIs) {
  EulerOptions options;
  options.mach = 0.5;
  options.alpha = 2;
  const auto lift = [&](std::int32_t outwards, double far) {
    const EulerResult result = solve_euler(world(), shared(airfoil_mesh(outwards, far)), options);
    EXPECT_TRUE(result.converged);
    return result.cl;
  };
  const double near = lift(16, 8), distant = lift(32, 128);
  options.far_field = EulerOptions::FarField::vortex;
  const double near_vortex = lift(16, 8), distant_vortex = lift(32, 128);
  EXPECT_LT(near, distant);
  EXPECT_LT(std::abs(near_vortex - distant_vortex), 0.25 * std::abs(near - distant));
  EXPECT_NEAR(distant_vortex, distant, 0.02 * distant);
}

TEST(SteadyFlow, RoundASymmetricBodyHasNoLiftAndEverLessDrag) {
  const Mesh mesh = shared(test::ring_mesh(64, 28, 0.3, 20)),
             coarse = shared(test::ring_mesh(32, 14, 0.3, 20));
  EulerOptions options;
  options.mach = 0.3;
  options.iterations = 300;
  const EulerResult result = solve_euler(world(), mesh, options);
  EXPECT_TRUE(result.converged) << result.residual;
  EXPECT_LT(result.residual, 1e-8);
  EXPECT_NEAR(result.cl, 0, 1e-5);
  EXPECT_LT(std::abs(result.cd),
            0.5 * std::abs(solve_euler(world(), coarse, options).cd));  // d'Alembert: none in the end
  options.alpha = 3;
  EXPECT_GT(solve_euler(world(), mesh, options).cl, 0.02);
}

TEST(SteadyFlow, StartsFromWhatItIsGiven) {
  const Mesh mesh = shared(test::ring_mesh(48, 16, 0.3, 10));
  EulerOptions options;
  options.mach = 0.4;
  options.limiter = EulerOptions::Limiter::none;  // its factors are no part of a start
  const EulerResult cold = solve_euler(world(), mesh, options),
                    warm = solve_euler(world(), mesh, options, cold.flow);
  EXPECT_TRUE(cold.converged);
  EXPECT_GT(cold.iterations, 8);
  EXPECT_TRUE(warm.converged);
  EXPECT_EQ(warm.iterations, 0);
  EXPECT_EQ(warm.flow.values, cold.flow.values);
  options.limiter = EulerOptions::Limiter::venkatakrishnan;
  const EulerResult limited = solve_euler(world(), mesh, options),
                    again = solve_euler(world(), mesh, options, limited.flow);
  EXPECT_TRUE(again.converged);
  EXPECT_LT(2 * again.iterations, limited.iterations);
}

TEST(BowShock, StandsBeforeABluntBody) {
  const Mesh mesh = shared(test::ring_mesh(64, 32, 1, 6));
  EulerOptions options;
  options.mach = 2;
  options.iterations = 250;
  options.tolerance = 0.005;  // the wake behind it never comes to rest
  const EulerResult result = solve_euler(world(), mesh, options);
  EXPECT_TRUE(result.converged) << result.residual;
  double largest = 0;
  for (std::size_t i = 3; i < result.flow.values.size(); i += 4)
    largest = std::max(largest, result.flow.values[i]);
  EXPECT_NEAR(world().maximum(largest) * 1.4, 5.640,
              0.08);  // pressure behind a normal shock at Mach 2, brought to rest
  EXPECT_NEAR(result.cl, 0, 2e-3);
}

TEST(Refusals, OptionsAreLookedAtFirst) {
  const Mesh mesh = shared(test::irregular_grid(4, {1, 1}, 0));
  EulerOptions options;
  options.gamma = 1;
  EXPECT_THROW(solve_euler(world(), mesh, options), InputError);
}

TEST(Refusals, AFlowThatIsNoneFailsWithItsPlace) {
  const Mesh mesh = shared(test::irregular_grid(6, {1, 1}, 0));
  EulerOptions options;
  Field start = disturbed(mesh, options, 0);
  if (world().is_root()) start.values[3] = -1;
  try {
    solve_euler(world(), mesh, options, start);
    FAIL() << "solved";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("pressure -1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quadloop::flow
