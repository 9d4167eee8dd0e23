// Viscous terms: stress and heat of linear fields, their matrix, what a shear flow between plates balances,
// nodes that stick to walls.
#include "flow/euler/scheme/viscous.hpp"

#include <gtest/gtest.h>

#include "flow/euler/scheme/no_slip.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

FlowModel viscous_model() {
  FlowModel model;
  model.viscosity = 0.3;
  model.prandtl = 0.72;
  return model;
}

TEST(ViscousFlux, IsStressWorkAndHeat) {
  const FlowModel model = viscous_model();
  const State state{1.2, 0.5, -0.25, 0.8};
  const ViscousGradient gradient{{2, -1}, {0.5, 3}, {4, -2}};
  const Point normal{0.6, 0.8};
  // tau = mu (grad v + its transpose - 2/3 div v), with div v = 5
  const double mu = 0.3, xx = mu * (4 - 10.0 / 3), xy = mu * (-1 + 0.5), yy = mu * (6 - 10.0 / 3);
  const double x = xx * 0.6 + xy * 0.8, y = xy * 0.6 + yy * 0.8;
  const double heat = mu / (0.4 * 0.72) * (4 * 0.6 - 2 * 0.8);  // c_p = 1 / (gamma - 1) where T = c^2
  const Flux flux = viscous_flux(model, state, gradient, normal);
  EXPECT_EQ(flux[0], 0);
  EXPECT_NEAR(flux[1], x, 1e-15);
  EXPECT_NEAR(flux[2], y, 1e-15);
  EXPECT_NEAR(flux[3], 0.5 * x - 0.25 * y + heat, 1e-14);
}

TEST(ViscousGradient, FollowsTheTemperature) {
  const Gas gas;
  const State state{1.2, 0.5, -0.25, 0.8};
  const Gradient gradient{{0.3, 1, 2, -0.4}, {-0.1, 3, 4, 0.2}};
  const ViscousGradient found = viscous_gradient(gas, state, gradient);
  EXPECT_EQ(found.x_velocity, (Point{1, 3}));
  EXPECT_EQ(found.y_velocity, (Point{2, 4}));
  constexpr double step = 1e-6;
  const State moved_x{1.2 + step * 0.3, 0, 0, 0.8 - step * 0.4},
      moved_y{1.2 - step * 0.1, 0, 0, 0.8 + step * 0.2};
  EXPECT_NEAR(found.temperature.x, (temperature(gas, moved_x) - temperature(gas, state)) / step, 1e-5);
  EXPECT_NEAR(found.temperature.y, (temperature(gas, moved_y) - temperature(gas, state)) / step, 1e-5);
}

TEST(ViscousGradient, BetweenNodesSeesTheirDifference) {
  const Gas gas;
  const State low{1, 1, 0, 1}, high{1, 4, 2, 1.5};
  const ViscousGradient at{{10, 7}, {10, 8}, {10, 9}};
  const ViscousGradient between = gradient_between(gas, low, high, at, at, {0.5, 0});
  EXPECT_EQ(between.x_velocity, (Point{6, 7}));
  EXPECT_EQ(between.y_velocity, (Point{4, 8}));
  EXPECT_NEAR(between.temperature.x, 1.4, 1e-14);
  EXPECT_EQ(between.temperature.y, 9);
}

TEST(ViscousMatrix, IsTheDerivativeOfTheThinLayerFlux) {
  const FlowModel model = viscous_model();
  const Gas gas;
  const State state{1.2, 0.5, -0.25, 0.8}, mean{1.1, 0.4, 0.1, 0.7};
  const Point normal{0.6, 0.8};
  const auto flux = [&](const State& s) {  // where the state alone varies, along the normal
    return viscous_flux(model, mean, {s[1] * normal, s[2] * normal, temperature(gas, s) * normal}, normal);
  };
  Matrix4 matrix{};
  add_viscous_matrix(model, state, mean, normal, 2, matrix);
  for (std::size_t column = 0; column < 4; ++column) {
    constexpr double step = 1e-6;
    const auto moved = [&](double by) {
      Conserved w = gas.conserved(state);
      (column == 0 ? w.mass : column == 1 ? w.x_momentum : column == 2 ? w.y_momentum : w.energy) += by;
      return flux(gas.state(w));
    };
    const Flux up = moved(step), down = moved(-step);
    for (std::size_t row = 0; row < 4; ++row)
      EXPECT_NEAR(matrix[4 * row + column], 2 * (up[row] - down[row]) / (2 * step), 1e-7) << row << column;
  }
}

/// What viscosity adds to the net fluxes of a flow given at each place, all boundaries open.
IdVector<NodeId, Flux> viscous_part(Mesh mesh, const std::function<State(Point)>& flow) {
  test::relabel(mesh, [](Point) { return "farfield"; });
  const DualMesh dual(world(), mesh);
  EulerOptions options;
  options.limiter = EulerOptions::Limiter::none;
  FlowModel with = flow_model(world(), mesh, options), without = with;
  with.viscosity = 0.3;
  with.prandtl = 0.72;
  IdVector<NodeId, State> states(dual.nodes());
  for (const NodeId node : dual.owned_ids()) states[node] = flow(dual.point(node));
  Residual viscous(dual, with, options), inviscid(dual, without, options);
  IdVector<NodeId, Flux> part = viscous.evaluate(states);
  const IdVector<NodeId, Flux>& rest = inviscid.evaluate(states);
  for (const NodeId node : part.ids()) {
    for (std::size_t k = 0; k < 4; ++k) part[node][k] -= rest[node][k];
  }
  return part;
}

TEST(ViscousTerms, OfALinearVelocityBalanceOnAnyMesh) {
  const Mesh mesh = test::irregular_grid(9, {1, 0.5}, 0.24);
  const auto part = viscous_part(mesh, [](Point p) {
    return State{1, 0.3 + 2 * p.x - p.y, 0.1 + 0.5 * p.x + 3 * p.y, 0.7};
  });
  for (const Flux& sum : part) {
    EXPECT_EQ(sum[0], 0);
    EXPECT_NEAR(sum[1], 0, 1e-13);
    EXPECT_NEAR(sum[2], 0, 1e-13);
  }
}

/// Couette's flow between plates a distance of 1 apart, the upper one moving: u = y, and the heat of friction
/// makes T = 1 + (gamma - 1) Pr y (1 - y) / 2.
TEST(ViscousTerms, OfCouettesFlowBalanceInLayers) {
  test::Grid grid{6, {1, 1}, true};
  Mesh mesh;
  mesh.owned_nodes = 49;
  for (std::int32_t node = 0; node < 49; ++node) {
    const Point p = grid.place(node);
    mesh.points.push_back({p.x, p.y * p.y});
  }
  const auto at = [](std::int32_t i, std::int32_t j) { return NodeId{7 * j + i}; };
  for (std::int32_t j = 0; j < 6; ++j) {
    for (std::int32_t i = 0; i < 6; ++i)
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  mesh.boundaries = grid.mesh().boundaries;
  const auto part = viscous_part(mesh, [](Point p) {
    return State{1.4 * 0.7 / (1 + 0.4 * 0.72 * p.y * (1 - p.y) / 2), p.y, 0, 0.7};
  });
  int inner = 0;
  for (std::int32_t node = 0; node < 49; ++node) {
    if (!grid.inner(node)) continue;
    for (const double value : part[NodeId{node}]) EXPECT_NEAR(value, 0, 1e-14) << node;
    ++inner;
  }
  EXPECT_EQ(inner, 25);
}

TEST(NoSlip, HoldsVelocityAndTemperature) {
  Mesh mesh = test::irregular_grid(4, {1, 1}, 0.1);
  test::relabel(mesh, [](Point p) { return p.y == 0 ? "cold" : p.x == 1 ? "adiabatic" : "farfield"; });
  EulerOptions options;
  options.viscosity = 0.01;
  options.boundaries = {{"cold", "wall", {}, 0.8}, {"adiabatic", "wall", {}}};
  const FlowModel model = flow_model(world(), mesh, options);
  const DualMesh dual(world(), mesh);
  const NoSlipNodes walls(dual, model);
  IdVector<NodeId, State> states(dual.nodes(), State{1.5, 0.5, 0.2, 0.7});
  walls.hold(states);
  IdVector<NodeId, Flux> sums(dual.nodes(), Flux{1, 2, 3, 4});
  IdVector<NodeId, Point> friction(dual.nodes());
  walls.take_friction(sums, friction);
  const IdVector<NodeId, char> held = walls.held_rows(dual.nodes());
  IdVector<NodeId, Matrix4> diagonal(dual.nodes(), Matrix4{7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7});
  walls.hold(diagonal);
  for (const NodeId node : dual.owned_ids()) {
    const Point p = dual.point(node);
    const bool cold = p.y == 0, stuck = cold || p.x == 1;
    EXPECT_EQ(states[node][1], stuck ? 0 : 0.5);
    EXPECT_EQ(states[node][2], stuck ? 0 : 0.2);
    EXPECT_NEAR(states[node][3], cold ? 1.5 * 0.8 / 1.4 : 0.7, 1e-15);
    EXPECT_EQ(sums[node], (stuck ? Flux{1, 0, 0, cold ? 0.0 : 4.0} : Flux{1, 2, 3, 4}));
    EXPECT_EQ(friction[node], (stuck ? Point{2, 3} : Point{}));
    EXPECT_EQ(held[node], cold ? 3 : stuck ? 2 : 0);
    const Matrix4& block = diagonal[node];
    EXPECT_EQ(block[0], 7);
    EXPECT_EQ(block[5], stuck ? 1 : 7);
    EXPECT_EQ(block[9], stuck ? 0 : 7);
    EXPECT_NEAR(block[12], cold ? -0.8 / (1.4 * 0.4) : 7, 1e-14);
  }
}

TEST(ViscousBoundary, SymmetryPullsAlongTheNormalAlone) {
  const FlowModel model = viscous_model();
  const State state{1, 0.5, 0, 0.7};
  const ViscousGradient gradient{{0, 2}, {0, 3}, {1, 1}};
  const Point down{0, -1};
  const Flux symmetry = viscous_boundary_flux(model, {Condition::symmetry}, state, gradient, down);
  EXPECT_NEAR(symmetry[1], 0, 1e-16);
  EXPECT_NEAR(symmetry[2], -0.3 * 4, 1e-14);
  EXPECT_EQ(symmetry[3], 0);
  EXPECT_EQ(viscous_boundary_flux(model, {Condition::no_slip}, state, gradient, down), Flux{});
  EXPECT_EQ(viscous_boundary_flux(model, {Condition::outflow}, state, gradient, down),
            viscous_flux(model, state, gradient, down));
}

}  // namespace
}  // namespace quadloop::flow::euler
