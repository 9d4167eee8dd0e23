// The built-in solver as the loop calls it.
#include "flow/euler/euler_solver.hpp"

#include <gtest/gtest.h>

#include "flow/flow_solver.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

Mesh ring() {
  const Mesh whole = test::ring_mesh(16, 6, 0.4, 6);
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

EulerOptions short_run() {
  EulerOptions options;
  options.mach = 0.4;
  options.alpha = 2;
  options.iterations = 6;
  options.progress_every = 2;
  return options;
}

TEST(EulerSolver, SaysWhatTheSolverSays) {
  const Mesh mesh = ring();
  const EulerResult result = solve_euler(world(), mesh, short_run());
  const SolvedFlow flow = euler_solver(short_run())(world(), mesh, {}, 3);
  EXPECT_EQ(flow.solution.values, result.flow.values);
  EXPECT_EQ(flow.cl, result.cl);
  EXPECT_EQ(flow.cd, result.cd);
  EXPECT_EQ(flow.residual, result.residual);
  EXPECT_EQ(flow.solution.constants,
            (std::vector<double>{6, result.time, 0.4, 2, result.cl, result.cd, result.residual}));
  ASSERT_GE(flow.notes.size(), 3U);
  EXPECT_TRUE(flow.notes.back().starts_with("step 6: residual ")) << flow.notes.back();
  ASSERT_EQ(flow.warnings.size(), 1U) << "six steps are too few";
  EXPECT_TRUE(flow.warnings[0].starts_with("cycle 3: ")) << flow.warnings[0];
  EXPECT_EQ(flow.steps, 6);
  const SolvedFlow alone = euler_solver(short_run())(world(), mesh, {}, -1);
  EXPECT_EQ("cycle 3: " + alone.warnings.at(0), flow.warnings[0]);
}

TEST(EulerSolver, TellsForcesOfEachBoundaryAndTheHistory) {
  const Mesh whole = [] {
    Mesh ring = test::ring_mesh(16, 6, 0.4, 6);
    test::relabel(ring, [](Point p) { return length(p) > 3 ? "farfield" : p.y > 0 ? "upper" : "lower"; });
    return ring;
  }();
  const Mesh mesh = scatter_mesh(world(), whole, space_filling_order(whole));
  for (const double viscosity : {0.0, 0.01}) {
    EulerOptions options = short_run();
    options.viscosity = viscosity;
    options.boundaries = {{"upper", "wall", {}}, {"lower", "wall", {}}};
    const SolvedFlow flow = euler_solver(options)(world(), mesh, {}, 0);
    ASSERT_EQ(flow.forces.size(), 2U);
    EXPECT_NEAR(flow.forces[0].cl + flow.forces[1].cl, *flow.cl, 1e-12);
    EXPECT_NEAR(flow.forces[0].cd + flow.forces[1].cd, *flow.cd, 1e-12);
    EXPECT_GT(std::abs(flow.forces[0].cl - flow.forces[1].cl), 1e-3);
    const std::vector<std::string> walls{flow.forces[0].boundary, flow.forces[1].boundary};
    const auto by_pressure = boundary_forces(world(), mesh, flow.solution, *flow.stream, walls);
    for (std::size_t k = 0; k < walls.size(); ++k) {
      EXPECT_NEAR(by_pressure[k].cd - by_pressure[k].cd_friction,
                  flow.forces[k].cd - flow.forces[k].cd_friction, 1e-12);
      EXPECT_EQ(flow.forces[k].cd_friction > 0, viscosity > 0);
    }
    ASSERT_EQ(flow.history.size(), 7U);
    EXPECT_EQ(flow.history.back().step, 6);
    EXPECT_EQ(flow.history.back().cd, *flow.cd);
    EXPECT_EQ(flow.history.back().residual, *flow.residual);
  }
}

TEST(EulerSolver, BeginsWithTheStateGiven) {
  const Mesh mesh = ring();
  const FlowSolver solver = euler_solver(short_run());
  const SolvedFlow first = solver(world(), mesh, {}, 0), second = solver(world(), mesh, first.solution, 1);
  EXPECT_NE(first.solution.values, second.solution.values);
  EXPECT_EQ(second.solution.values, solve_euler(world(), mesh, short_run(), first.solution).flow.values);
}

TEST(EulerSolver, WarnsOfNothingWhereTheFlowConverged) {
  EulerOptions options = short_run();
  options.tolerance = 0.99;
  options.iterations = 50;
  EXPECT_TRUE(euler_solver(options)(world(), ring(), {}, 0).warnings.empty());
}

TEST(EulerSolver, ThrowsWhatTheSolverThrows) {
  EulerOptions options = short_run();
  options.mach = -1;
  EXPECT_THROW(euler_solver(options)(world(), ring(), {}, 0), InputError);
}

}  // namespace
}  // namespace quadloop::flow
