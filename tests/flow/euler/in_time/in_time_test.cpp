// Steps in time: their orders, what they solve, and means over time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/euler/implicit/newton_system.hpp"
#include "flow/euler/in_time/backward_difference.hpp"
#include "flow/euler/in_time/runge_kutta.hpp"
#include "flow/euler/in_time/time_average.hpp"
#include "flow/euler/in_time/time_scheme.hpp"
#include "flow/euler/march.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

constexpr double end = 1.2;

Mesh grid(std::int32_t cells) {
  Mesh whole = test::irregular_grid(cells, {10, 10}, 0.15);
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

/// A vortex that drifts over irregular cells, so many along each side.
struct VortexRun {
  explicit VortexRun(std::int32_t cells = 20)
      : mesh{grid(cells)},
        dual{world(), mesh},
        options{vortex_options()},
        model{flow_model(world(), mesh, options)},
        flow{world(),
             options,
             dual,
             model,
             Residual(dual, model, options),
             IdVector<NodeId, State>(dual.nodes(), model.free_stream)} {
    const Vortex vortex{model.gas, model.free_stream, {4.6, 4.7}, 1};
    for (const NodeId node : dual.owned_ids()) states[node] = vortex.state(dual.point(node), 0);
  }
  /// To the end in steps of these sizes, again and again.
  IdVector<NodeId, State> go(TimeScheme& scheme, const std::vector<double>& steps) {
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
  FlowRun flow;
  Residual& residual = flow.residual;
  IdVector<NodeId, State>& states = flow.states;
};

IdVector<NodeId, State> by_backward_difference(const std::vector<double>& steps) {
  VortexRun run;
  BackwardDifference scheme(run.flow, steps[0]);
  IdVector<NodeId, State> states = run.go(scheme, steps);
  EXPECT_EQ(scheme.unsolved(), 0);
  return states;
}

IdVector<NodeId, State> by_runge_kutta(double step) {
  VortexRun run;
  RungeKutta scheme(run.flow, 0.8);
  EXPECT_LT(step, scheme.longest_step());
  return run.go(scheme, {step});
}

double distance(const IdVector<NodeId, State>& a, const IdVector<NodeId, State>& b) {
  std::vector<double> squares;
  for (const NodeId node : a.ids()) {
    for (std::size_t k = 0; k < 4; ++k)
      squares.push_back((a[node][k] - b[node][k]) * (a[node][k] - b[node][k]));
  }
  return std::sqrt(reproducible_sum(world(), squares));
}

TEST(BackwardDifference, IsOfOrderTwo) {
  const IdVector<NodeId, State> exact = by_runge_kutta(0.02);
  const double coarse = distance(by_backward_difference({0.12}), exact),
               fine = distance(by_backward_difference({0.06}), exact),
               finest = distance(by_backward_difference({0.03}), exact);
  EXPECT_GT(coarse / fine, 3.3);
  EXPECT_GT(fine / finest, 3.5);
  EXPECT_LT(fine / finest, 4.7);
}

TEST(BackwardDifference, IsOfOrderTwoInUnequalSteps) {
  const IdVector<NodeId, State> exact = by_runge_kutta(0.02);
  const double coarse = distance(by_backward_difference({0.04, 0.08}), exact),
               fine = distance(by_backward_difference({0.02, 0.04}), exact);
  EXPECT_GT(coarse / fine, 3.2);
}

TEST(RungeKutta, IsOfOrderThree) {
  const IdVector<NodeId, State> exact = by_runge_kutta(0.006);
  const double coarse = distance(by_runge_kutta(0.048), exact), fine = distance(by_runge_kutta(0.024), exact);
  EXPECT_GT(coarse / fine, 6.5);
}

/// Gas beside all but a vacuum, in a step eight times as long as is stable: in halves it is not.
TEST(RungeKutta, TakesAStepInHalvesRatherThanLeaveNoGas) {
  VortexRun run;
  for (const NodeId node : run.dual.owned_ids()) {
    if (run.dual.point(node).x > 5) run.states[node] = {0.05, 0, 0, 0.02};
  }
  RungeKutta scheme(run.flow, 0.8);
  const double step = 8 * scheme.longest_step();
  scheme.advance(step, run.residual.evaluate(run.states));
  for (const NodeId node : run.dual.owned_ids()) {
    EXPECT_GT(run.states[node][0], 0) << node.value();
    EXPECT_GT(run.states[node][3], 0) << node.value();
  }
}

/// A step that no halves make bearable ends with the flow in which it first failed, also beside a rank
/// without nodes.
void expect_states_of_first_failure(std::int32_t cells) {
  VortexRun run(cells);
  for (const NodeId node : run.dual.owned_ids()) {
    if (run.dual.point(node).x > 5) run.states[node] = {0.05, 40, 0, 1e-5};
  }
  const IdVector<NodeId, State> start = run.states;
  RungeKutta scheme(run.flow, 0.8);
  EXPECT_FALSE(scheme.advance(1e5 * scheme.longest_step(), run.residual.evaluate(run.states)));
  std::int64_t without_gas = 0, not_finite = 0;
  for (const NodeId node : run.dual.owned_ids()) {
    without_gas += is_gas(run.states[node]) ? 0 : 1;
    not_finite += std::isnan(run.states[node][3]) ? 1 : 0;
  }
  EXPECT_GT(world().sum(without_gas), 0);
  EXPECT_EQ(world().sum(not_finite), 0) << "neighbours are not spoilt yet";
}

TEST(RungeKutta, LeavesTheStatesInWhichItFirstFailed) {
  expect_states_of_first_failure(20);
  expect_states_of_first_failure(1);
}

TEST(BackwardDifference, CountsAStepOnceHoweverManyOfItsPartsWereNotSolved) {
  VortexRun run;
  for (const NodeId node : run.dual.owned_ids()) {
    if (run.dual.point(node).x > 5) run.states[node] = {1, 8, 0, 0.01};
    if (run.dual.point(node).x < 3) run.states[node] = {0.01, -8, 0, 0.001};
  }
  BackwardDifference scheme(run.flow, 1e3);
  scheme.advance(1e3, run.residual.evaluate(run.states));
  EXPECT_EQ(scheme.unsolved(), 1);
}

TEST(TimeScheme, IsImplicitWhereAStepIsGiven) {
  VortexRun run;
  EXPECT_TRUE(time_scheme(run.flow, 0.5, 20)->is_implicit());
  EXPECT_EQ(time_scheme(run.flow, 0.5, 20)->longest_step(), 0.5);
  const auto explicit_one = time_scheme(run.flow, {}, 20);
  EXPECT_FALSE(explicit_one->is_implicit());
  EXPECT_EQ(explicit_one->longest_step(), time_scheme(run.flow, {}, 0.8)->longest_step());
}

TEST(TimeAverage, WeighsByDuration) {
  const auto states_of = [](State first) { return IdVector<NodeId, State>({first, {5, 5, 5, 5}}); };
  const auto pulls_of = [](Point first) { return IdVector<NodeId, Point>({first, {9, 9}}); };
  TimeAverage average;
  EXPECT_TRUE(average.empty());
  average.add(states_of({1, 0, 0, 2}), pulls_of({1, 2}), 1, 1);
  average.add(states_of({2, 4, 0, 1}), pulls_of({2, 0}), 1, 3);
  EXPECT_FALSE(average.empty());
  IdVector<NodeId, State> states(2, State{7, 7, 7, 7});
  average.take(states);
  EXPECT_EQ(states[NodeId{0}], (State{1.75, 3, 0, 1.25}));
  EXPECT_EQ(states[NodeId{1}], (State{7, 7, 7, 7}));  // not owned
  ASSERT_EQ(average.friction().size(), 1U);
  EXPECT_EQ(average.friction()[NodeId{0}].x, 1.75);
  EXPECT_EQ(average.friction()[NodeId{0}].y, 0.5);
}

/// A pulse leaves a ring: nothing is steady meanwhile.
EulerOptions transferred() {
  EulerOptions options;
  options.mach = 0.4;
  options.alpha = 4;
  options.iterations = 4;
  options.unsteady = EulerOptions::Unsteady::continue_in_time;
  options.flow_throughs = 2;
  return options;
}

Mesh coarse_ring() {
  const Mesh whole = test::ring_mesh(24, 8, 0.3, 6);
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

TEST(ContinueInTime, LeavesMeansAndTheFlowAtTheEnd) {
  const Mesh mesh = coarse_ring();
  for (const std::optional<double> step : {std::optional<double>{}, std::optional{0.05}}) {
    EulerOptions options = transferred();
    options.time_step = step;
    const EulerResult result = solve_euler(world(), mesh, options);
    ASSERT_TRUE(result.unsteady);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.unsteady->steady_steps, 4);
    EXPECT_EQ(result.unsteady->implicit, step.has_value());
    EXPECT_EQ(result.unsteady->unsolved, 0);
    EXPECT_NEAR(result.time, 2 * 1 / 0.4, 1e-12);  // the body is one unit long
    EXPECT_GE(result.unsteady->from, 0.5 * result.time);
    EXPECT_LE(result.unsteady->from, 0.5 * result.time + result.unsteady->longest_step);
    EXPECT_EQ(result.unsteady->cl.mean, result.cl);
    EXPECT_GT(result.cl, result.unsteady->cl.smallest);
    EXPECT_LT(result.cl, result.unsteady->cl.largest);
    const UnsteadyFlow of_rows = unsteady_flow(result.history, result.unsteady->from);
    EXPECT_NEAR(of_rows.cl.mean, result.cl, step ? 1e-10 : 1e-2);  // of explicit steps every tenth has a row
    ASSERT_EQ(result.flow.names.size(), 8U);
    EXPECT_EQ(result.flow.names[4], at_end_names[0]);
  }
}

TEST(ContinueInTime, GoesOnFromTheEndOfAMean) {
  const Mesh mesh = coarse_ring();
  EulerOptions options = transferred();
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

TEST(ContinueInTime, EndsWhereTheFlowIsSteadyAfterAll) {
  const Mesh mesh = coarse_ring();
  EulerOptions options = transferred();
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

/// A field with these variables: next to a vacuum that gas runs away from. No step in time bears it.
Field hopeless(const Mesh& mesh, const std::array<const char*, 4>& names) {
  Field field;
  field.names = {names.begin(), names.end()};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double speed = mesh.point(NodeId{node}).x > 0.2 ? 40 : -40;
    for (const double value : {0.05, speed, 0.0, 1e-5}) field.values.push_back(value);
  }
  return field;
}

/// A mean that is sound, and such a flow at its end.
Field hopeless_at_end(const Mesh& mesh) {
  const Field last = hopeless(mesh, at_end_names);
  Field start;
  start.names = {euler_names.begin(), euler_names.end()};
  start.names.insert(start.names.end(), last.names.begin(), last.names.end());
  for (std::size_t row = 0; row < last.values.size(); row += 4) {
    for (const double value : {1.0, 0.4, 0.02, 1 / 1.4}) start.values.push_back(value);
    start.values.insert(start.values.end(), last.values.begin() + row, last.values.begin() + row + 4);
  }
  return start;
}

TEST(ContinueInTime, FallsBackToTheSteadyFlow) {
  const Mesh mesh = coarse_ring();
  EulerOptions options = transferred(), steady = options;
  steady.unsteady = EulerOptions::Unsteady::stop;
  const Field start = hopeless(mesh, euler_names);
  const EulerResult fallen = solve_euler(world(), mesh, options, start),
                    kept = solve_euler(world(), mesh, steady, start);
  EXPECT_FALSE(fallen.failed_in_time.empty());
  EXPECT_FALSE(fallen.unsteady);
  EXPECT_FALSE(fallen.converged);
  EXPECT_EQ(fallen.flow.names, kept.flow.names);
  EXPECT_EQ(fallen.flow.values, kept.flow.values);
  EXPECT_EQ(fallen.iterations, 4);
  EXPECT_EQ(fallen.time, 0);
  EXPECT_EQ(fallen.cd, kept.cd);
  EXPECT_EQ(fallen.residual, kept.residual);
  EXPECT_EQ(fallen.history.size(), kept.history.size());
  const std::string said = shortfall(fallen, options);
  for (const char* const words :
       {"could not be continued in time", "at (", "try a smaller cfl", "flow of step "})
    EXPECT_NE(said.find(words), std::string::npos) << said;
}

TEST(ContinueInTime, FallsBackToASteadyFlowFromAStartThatCannotGoOn) {
  const Mesh mesh = coarse_ring();
  const Field start = hopeless_at_end(mesh);
  for (const double viscosity : {0.0, 1e-3}) {  // with one the means slip along walls, as carried flows do
    EulerOptions options = transferred();
    options.viscosity = viscosity;
    EulerOptions steady = options;
    steady.unsteady = EulerOptions::Unsteady::stop;
    const EulerResult fallen = solve_euler(world(), mesh, options, start),
                      kept = solve_euler(world(), mesh, steady, start);
    EXPECT_FALSE(fallen.failed_in_time.empty());
    EXPECT_FALSE(fallen.unsteady);
    EXPECT_EQ(fallen.iterations, 4);
    EXPECT_EQ(fallen.flow.names.size(), viscosity > 0 ? 5U : 4U);
    EXPECT_EQ(fallen.flow.values, kept.flow.values);
  }
}

/// Steps that fail take many sums over ranks: one rank does.
TEST(MarchInTime, TellsOfStepsThatWereNotSolvedWithoutMeansToo) {
  const Communicator alone(MPI_COMM_SELF);
  const Mesh whole = test::ring_mesh(24, 8, 0.3, 6);
  const Mesh mesh = scatter_mesh(alone, whole, space_filling_order(whole));
  EulerOptions options;
  options.mach = 0.4;
  options.time = EulerOptions::Time::accurate;
  options.end_time = 200;
  options.time_step = 100;
  const Field start = hopeless(mesh, euler_names);
  const EulerResult result = solve_euler(alone, mesh, options, start);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.unsolved, 2);
  const std::vector<std::string> lines = shortfalls(result, options);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("2 of 2 implicit time steps did not converge"), std::string::npos) << lines[0];
  options.average_from = 0;
  const EulerResult means = solve_euler(alone, mesh, options, start);
  ASSERT_TRUE(means.unsteady);
  EXPECT_EQ(means.unsteady->unsolved, 2);
  EXPECT_TRUE(shortfalls(means, options).empty()) << "told with the means";
}

TEST(ContinueInTime, RefusesStepsWithoutEnd) {
  const Mesh mesh = coarse_ring();
  const auto refusal = [&mesh](const EulerOptions& options) -> std::string {
    try {
      solve_euler(world(), mesh, options);
    } catch (const InputError& fault) {
      return fault.what();
    }
    return {};
  };
  EulerOptions options = transferred();
  options.time_step = 1e-300;
  EXPECT_NE(refusal(options).find("5e+300 steps of 1e-300"), std::string::npos) << refusal(options);
  EXPECT_NE(refusal(options).find("time_step of 0.062"), std::string::npos) << refusal(options);
  options.time_step = {};
  options.flow_throughs = 1e6;
  EXPECT_NE(refusal(options).find("reduce solver.flow_throughs"), std::string::npos) << refusal(options);
  options = transferred();
  options.unsteady = EulerOptions::Unsteady::stop;
  options.time = EulerOptions::Time::accurate;
  options.time_step = 1e-8;
  EXPECT_NE(refusal(options).find("time_step of 1e-07 or more"), std::string::npos) << refusal(options);
}

}  // namespace
}  // namespace quadloop::flow::euler
