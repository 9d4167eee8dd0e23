// The built-in solver as the loop calls it.
#include "flow/euler/euler_solver.hpp"

#include <gtest/gtest.h>

#include "flow/flow_solver.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
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
  EXPECT_TRUE(flow.notes.back().starts_with("iteration 6: residual ")) << flow.notes.back();
  ASSERT_EQ(flow.warnings.size(), 1U) << "six steps are too few";
  EXPECT_TRUE(flow.warnings[0].starts_with("cycle 3: ")) << flow.warnings[0];
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
}  // namespace quadloop
