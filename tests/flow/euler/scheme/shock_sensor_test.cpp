// Where strong shocks stand, and what Roe's flux becomes there.
#include "flow/euler/scheme/shock_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/euler/model/flux.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

TEST(ShockShare, RisesBetweenItsTwoJumps) {
  EXPECT_EQ(shock_share(0.7), 0);
  EXPECT_EQ(shock_share(1.2), 1);
  EXPECT_NEAR(shock_share(0.95), 0.5, 1e-12);
  EXPECT_NEAR(pressure_jump(2.0, 3.0, 0.5), 0.5, 1e-15);
  EXPECT_NEAR(pressure_jump(3.0, 2.0, 4.0), 0.25, 1e-15);
}

/// A jump of pressure between columns of nodes: those beside it have a share, on either side.
TEST(ShockSensor, FindsNodesBesideAJumpUntilItIsKept) {
  const Mesh whole = test::irregular_grid(9, {1, 1}, 0.2);
  const Mesh mesh = scatter_mesh(test::world(), whole, space_filling_order(whole));
  const DualMesh dual(test::world(), mesh);
  IdVector<NodeId, State> states(dual.nodes(), State{1, 0, 0, 1});
  for (const NodeId node : dual.ids()) {
    if (dual.point(node).x > 0.5) states[node][3] = 3;
  }
  ShockSensor sensor(dual, 0.7);
  sensor.find(states);
  double largest = 0, alone = 0;
  for (const DualEdge& edge : dual.edges()) {
    const bool beside = states[edge.low][3] != states[edge.high][3];
    if (beside) {
      EXPECT_EQ(sensor.share(edge.low, edge.high), 1);
    }
    largest = std::max(largest, sensor.share(edge.low, edge.high));
    if (std::max(dual.point(edge.low).x, dual.point(edge.high).x) < 0.25)
      alone = std::max(alone, sensor.share(edge.low, edge.high));
  }
  EXPECT_EQ(largest, 1);
  EXPECT_EQ(alone, 0);
  sensor.freeze();
  sensor.find(IdVector<NodeId, State>(dual.nodes(), State{1, 0, 0, 1}));
  double kept = 0;
  for (const DualEdge& edge : dual.edges()) kept = std::max(kept, sensor.share(edge.low, edge.high));
  EXPECT_EQ(kept, 1);
}

/// Through a face along the flow, between states that differ in density and in the speed along the face
/// alone, Roe's flux carries next to nothing; with the whole share what the flux of Harten, Lax and van Leer
/// does.
TEST(RoeFlux, BesideAShockDampsWhatVariesAlongIt) {
  const Gas gas;
  const State left{1, 2, 0, 1 / 1.4}, right{1.2, 1.5, 0, 1 / 1.4};
  const Point across{0, 1};
  const Flux roe = roe_flux(gas, left, right, across), damped = roe_flux(gas, left, right, across, 1);
  const double sound = roe_average(gas, left, right).sound;
  EXPECT_LT(std::abs(roe[0]), 0.01 * std::abs(damped[0]) * 2);
  EXPECT_NEAR(damped[0], -0.5 * sound * 0.2, 1e-12);
  EXPECT_NEAR(damped[1], -0.5 * sound * (1.2 * 1.5 - 2), 1e-12);
}

}  // namespace
}  // namespace quadloop::flow::euler
