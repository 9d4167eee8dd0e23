// Steps in time: their orders, what they solve, and means over time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/implicit/newton_system.hpp"
#include "flow/euler/in_time/backward_difference.hpp"
#include "flow/euler/in_time/runge_kutta.hpp"
#include "flow/euler/in_time/time_average.hpp"
#include "flow/euler/in_time/time_scheme.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::euler {
namespace {

using test::world;

constexpr double end = 1.2;

Mesh grid() {
  Mesh whole = test::irregular_grid(20, {10, 10}, 0.15);
  test::relabel(whole, [](Point) { return "farfield"; });
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

EulerOptions vortex_options() {
  EulerOptions options;
  options.mach = 0.5;
  options.alpha = 30;
  options.limiter = EulerOptions::Limiter::none;
  return options;
}

/// A vortex that drifts over irregular cells.
struct VortexRun {
  VortexRun()
      : mesh{grid()},
        dual{world(), mesh},
        options{vortex_options()},
        model{flow_model(world(), mesh, options)},
        residual{dual, model, options},
        states(dual.nodes(), model.free_stream) {
    const Vortex vortex{model.gas, model.free_stream, {4.6, 4.7}, 1};
    for (std::int32_t node = 0; node < dual.owned_nodes(); ++node)
      states[node] = vortex.state(dual.point(node), 0);
  }
  TimeRun in_time() { return {world(), dual, model, residual, states}; }
  /// To the end in steps of these sizes, again and again.
  std::vector<State> go(TimeScheme& scheme, const std::vector<double>& steps) {
    double time = 0;
    for (std::size_t k = 0; time < end * (1 - 1e-9); ++k) {
      const double step = std::min(steps[k % steps.size()], end - time);
      scheme.advance(step, residual.evaluate(states));
      time += step;
    }
    states.resize(dual.owned_nodes());
    return states;
  }

  Mesh mesh;
  DualMesh dual;
  EulerOptions options;
  FlowModel model;
  Residual residual;
  std::vector<State> states;
};

std::vector<State> by_backward_difference(const std::vector<double>& steps) {
  VortexRun run;
  BackwardDifference scheme(run.in_time(), steps[0]);
  std::vector<State> states = run.go(scheme, steps);
  EXPECT_EQ(scheme.unsolved(), 0);
  return states;
}

std::vector<State> by_runge_kutta(double step) {
  VortexRun run;
  RungeKutta scheme(run.in_time(), 0.8);
  EXPECT_LT(step, scheme.longest_step());
  return run.go(scheme, {step});
}

double distance(const std::vector<State>& a, const std::vector<State>& b) {
  std::vector<double> squares;
  for (std::size_t node = 0; node < a.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k)
      squares.push_back((a[node][k] - b[node][k]) * (a[node][k] - b[node][k]));
  }
  return std::sqrt(reproducible_sum(world(), squares));
}

TEST(BackwardDifference, IsOfOrderTwo) {
  const std::vector<State> exact = by_runge_kutta(0.02);
  const double coarse = distance(by_backward_difference({0.12}), exact),
               fine = distance(by_backward_difference({0.06}), exact),
               finest = distance(by_backward_difference({0.03}), exact);
  EXPECT_GT(coarse / fine, 3.3);
  EXPECT_GT(fine / finest, 3.5);
  EXPECT_LT(fine / finest, 4.7);
}

TEST(BackwardDifference, IsOfOrderTwoInUnequalSteps) {
  const std::vector<State> exact = by_runge_kutta(0.02);
  const double coarse = distance(by_backward_difference({0.04, 0.08}), exact),
               fine = distance(by_backward_difference({0.02, 0.04}), exact);
  EXPECT_GT(coarse / fine, 3.2);
}

TEST(RungeKutta, IsOfOrderThree) {
  const std::vector<State> exact = by_runge_kutta(0.006);
  const double coarse = distance(by_runge_kutta(0.048), exact), fine = distance(by_runge_kutta(0.024), exact);
  EXPECT_GT(coarse / fine, 6.5);
}

/// Gas beside all but a vacuum, in a step eight times as long as is stable: in halves it is not.
TEST(RungeKutta, TakesAStepInHalvesRatherThanLeaveNoGas) {
  VortexRun run;
  for (std::int32_t node = 0; node < run.dual.owned_nodes(); ++node) {
    if (run.dual.point(node).x > 5) run.states[node] = {0.05, 0, 0, 0.02};
  }
  RungeKutta scheme(run.in_time(), 0.8);
  const double step = 8 * scheme.longest_step();
  scheme.advance(step, run.residual.evaluate(run.states));
  for (std::int32_t node = 0; node < run.dual.owned_nodes(); ++node) {
    EXPECT_GT(run.states[node][0], 0) << node;
    EXPECT_GT(run.states[node][3], 0) << node;
  }
}

TEST(TimeScheme, IsImplicitWhereAStepIsGiven) {
  VortexRun run;
  EXPECT_TRUE(time_scheme(run.in_time(), 0.5, 20)->is_implicit());
  EXPECT_EQ(time_scheme(run.in_time(), 0.5, 20)->longest_step(), 0.5);
  const auto explicit_one = time_scheme(run.in_time(), {}, 20);
  EXPECT_FALSE(explicit_one->is_implicit());
  EXPECT_EQ(explicit_one->longest_step(), time_scheme(run.in_time(), {}, 0.8)->longest_step());
}

TEST(TimeAverage, WeighsByDuration) {
  TimeAverage average;
  EXPECT_TRUE(average.empty());
  average.add({{1, 0, 0, 2}, {5, 5, 5, 5}}, {{1, 2}, {9, 9}}, 1, 1);
  average.add({{2, 4, 0, 1}, {5, 5, 5, 5}}, {{2, 0}, {9, 9}}, 1, 3);
  EXPECT_FALSE(average.empty());
  std::vector<State> states(2, State{7, 7, 7, 7});
  average.take(states);
  EXPECT_EQ(states[0], (State{1.75, 3, 0, 1.25}));
  EXPECT_EQ(states[1], (State{7, 7, 7, 7}));  // not owned
  ASSERT_EQ(average.friction().size(), 1U);
  EXPECT_EQ(average.friction()[0].x, 1.75);
  EXPECT_EQ(average.friction()[0].y, 0.5);
}

/// A pulse leaves a ring: nothing is steady meanwhile.
EulerOptions carried() {
  EulerOptions options;
  options.mach = 0.4;
  options.alpha = 4;
  options.iterations = 4;
  options.unsteady = EulerOptions::Unsteady::carry_on;
  options.flow_throughs = 2;
  return options;
}

Mesh ring() {
  const Mesh whole = test::ring_mesh(24, 8, 0.3, 6);
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

TEST(CarryOn, LeavesMeansAndTheFlowAtTheEnd) {
  const Mesh mesh = ring();
  for (const std::optional<double> step : {std::optional<double>{}, std::optional{0.05}}) {
    EulerOptions options = carried();
    options.time_step = step;
    const EulerResult result = solve_euler(world(), mesh, options);
    ASSERT_TRUE(result.unsteady);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.unsteady->steady_steps, 4);
    EXPECT_EQ(result.unsteady->implicit, step.has_value());
    EXPECT_EQ(result.unsteady->unsolved, 0);
    EXPECT_NEAR(result.time, 2 * 1 / 0.4, 1e-12);  // the body is one unit long
    EXPECT_GE(result.unsteady->from, 0.5 * result.time);
    EXPECT_EQ(result.unsteady->cl.mean, result.cl);
    EXPECT_GT(result.cl, result.unsteady->cl.smallest);
    EXPECT_LT(result.cl, result.unsteady->cl.largest);
    const UnsteadyFlow of_rows = unsteady_flow(result.history, result.unsteady->from);
    EXPECT_NEAR(of_rows.cl.mean, result.cl, step ? 1e-10 : 1e-2);  // of explicit steps every tenth has a row
    ASSERT_EQ(result.flow.names.size(), 8U);
    EXPECT_EQ(result.flow.names[4], at_end_names[0]);
  }
}

TEST(CarryOn, GoesOnFromTheEndOfAMean) {
  const Mesh mesh = ring();
  EulerOptions options = carried();
  options.time_step = 0.05;
  const EulerResult first = solve_euler(world(), mesh, options),
                    more = solve_euler(world(), mesh, options, first.flow);
  ASSERT_TRUE(more.unsteady);
  EXPECT_EQ(more.unsteady->steady_steps, 0);
  EXPECT_EQ(more.iterations, more.unsteady->steps);
  EXPECT_EQ(more.history.front().cl, first.history.back().cl);
  options.unsteady = EulerOptions::Unsteady::stop;
  options.time_step = {};
  const EulerResult steady = solve_euler(world(), mesh, options, first.flow);
  EXPECT_NEAR(steady.history.front().cl, first.cl, 1e-12);  // begins with the means
}

TEST(CarryOn, EndsWhereTheFlowIsSteadyAfterAll) {
  const Mesh mesh = ring();
  EulerOptions options = carried();
  options.alpha = 0;
  options.tolerance = 0.02;
  options.flow_throughs = 100;
  const EulerResult result = solve_euler(world(), mesh, options);
  EXPECT_FALSE(result.unsteady);
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 0.02);
  EXPECT_GT(result.iterations, 4);
  EXPECT_EQ(result.flow.names.size(), 4U);
}

}  // namespace
}  // namespace quadloop::euler
