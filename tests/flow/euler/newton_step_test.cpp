// Newton steps near a steady flow.
#include "flow/euler/newton_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "flow/euler/implicit/state_update.hpp"
#include "flow/euler/march.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

Mesh fine_ring() {
  const Mesh whole = test::ring_mesh(32, 12, 0.3, 10);
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

TEST(NewtonStep, FallsFasterTheNearerTheEnd) {
  const Mesh mesh = fine_ring();
  EulerOptions options;
  options.mach = 0.3;
  options.limiter = EulerOptions::Limiter::none;
  options.tolerance = 1e-3;
  const EulerResult near = solve_euler(world(), mesh, options);
  const DualMesh dual(world(), mesh);
  const FlowModel model = flow_model(world(), mesh, options);
  IdVector<NodeId, State> states(dual.nodes(), model.free_stream);
  for (const NodeId node : dual.owned_ids()) std::ranges::copy(near.flow.row(node), states[node].begin());
  FlowRun run{world(), options, dual, model, Residual(dual, model, options), std::move(states)};
  ImplicitSystem system(world(), dual, model);
  NewtonStep newton(run, system);
  const IdVector<NodeId, double> shares(dual.owned_nodes(), 1.0);
  double before = mass_residual(run, run.residual.evaluate(run.states));
  for (int step = 0; step < 4; ++step) {
    const NewtonStep::Taken taken = newton.take(run.residual.evaluate(run.states), 1e6, shares);
    EXPECT_EQ(taken.share, 1);
    EXPECT_LT(taken.left_over, 0.11);
    const double now = mass_residual(run, run.residual.evaluate(run.states));
    EXPECT_LT(now, 0.2 * before) << step;
    before = now;
  }
}

TEST(StateUpdate, KeepsDensityAndPressureFromVanishing) {
  const Gas gas;
  const State state{1, 0.5, 0, 1 / 1.4};
  const State small = updated(gas, state, {0.1, 0.05, 0, 0.1});
  EXPECT_NEAR(small[0], 1.1, 1e-15);
  const State large = updated(gas, state, {-5, 0, 0, -5});
  EXPECT_GE(large[0], 0.75 - 1e-12);
  EXPECT_GT(large[3], 0.5 * state[3]);
}

TEST(StateUpdate, LetsANodeLeaveAVacuum) {
  const Gas gas;
  const State thin{1e-6, 0, 0, 1e-12};
  const State filled = updated(gas, thin, {0.02, 0, 0, 0.01});
  EXPECT_GT(filled[0], 0.01);
  EXPECT_GT(filled[3], 1e-3);
}

}  // namespace
}  // namespace quadloop::flow::euler
