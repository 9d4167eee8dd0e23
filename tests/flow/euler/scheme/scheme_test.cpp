// The parts of the scheme: the dual mesh closes, gradients are exact, residuals conserve.
#include <gtest/gtest.h>

#include "flow/euler/model/euler_options.hpp"
#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/model/gas.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/reconstruction.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/flow/euler/made_up_states.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::made_up_state;
using test::world;

TEST(DualMesh, FillsTheMeshAndClosesRoundEachNode) {
  const Mesh mesh = test::irregular_grid(12, {3, 2}, 0.2);
  const DualMesh dual(world(), mesh);
  double area = 0;
  for (const double part : dual.areas()) area += part;
  EXPECT_NEAR(area, 6, 1e-12);
  IdVector<NodeId, Point> sums(dual.nodes());
  for (const DualEdge& edge : dual.edges()) {
    EXPECT_LT(dual.global(edge.low), dual.global(edge.high));
    sums[edge.low] = sums[edge.low] + edge.size * edge.normal;
    sums[edge.high] = sums[edge.high] - edge.size * edge.normal;
  }
  for (const BoundaryFace& face : dual.faces()) {
    for (const NodeId node : {face.from, face.to}) {
      sums[node] = sums[node] + face.half_size * face.normal;
    }
  }
  for (const Point& sum : sums) EXPECT_LT(length(sum), 1e-15);
}

TEST(DualMesh, RefusesAnEdgeWithoutBoundary) {
  Mesh mesh = test::irregular_grid(4, {1, 1}, 0);
  mesh.boundaries[1].edges.pop_back();
  EXPECT_THROW(DualMesh(world(), mesh), InputError);
  mesh = test::irregular_grid(4, {1, 1}, 0);
  mesh.boundaries[1].edges.push_back(mesh.boundaries[1].edges.back());
  EXPECT_THROW(DualMesh(world(), mesh), InputError);
}

TEST(LeastSquares, IsExactForLinearFields) {
  const Mesh mesh = test::irregular_grid(12, {3, 2}, 0.24);
  const DualMesh dual(world(), mesh);
  const std::array<Point, 4> slopes{{{1, 2}, {-0.5, 0.25}, {0, 3}, {-2, 0}}};
  IdVector<NodeId, State> states(dual.nodes());
  for (const NodeId node : dual.owned_ids()) {
    for (std::size_t k = 0; k < 4; ++k) states[node][k] = 1.0 + dot(slopes[k], dual.point(node));
  }
  IdVector<NodeId, Gradient> gradients(dual.nodes());
  LeastSquares(dual).compute(states, gradients);
  const IdVector<NodeId, Gradient> full = gradients;
  Limiter(dual, 1).apply(states, gradients);
  for (const NodeId node : gradients.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(full[node].x[k], slopes[k].x, 1e-12);
      EXPECT_NEAR(full[node].y[k], slopes[k].y, 1e-12);
      EXPECT_LE(std::abs(gradients[node].x[k]), std::abs(full[node].x[k]) * (1 + 1e-15));
    }
  }
}

TEST(Limiter, FlattensAPeakAndLeavesAConstantAlone) {
  const Mesh mesh = test::irregular_grid(8, {1, 1}, 0);
  const DualMesh dual(world(), mesh);
  IdVector<NodeId, State> states(dual.nodes(), State{1, 0, 0, 1});
  IdVector<NodeId, Gradient> gradients(dual.nodes(), Gradient{{8, 0, 0, 0}, {0, 0, 0, 0}});
  constexpr NodeId middle{40};
  states[middle][0] = 3;
  Limiter limiter(dual, 1e6);  // in units so large that nothing counts as small
  limiter.apply(states, gradients);
  EXPECT_LT(std::abs(gradients[middle].x[0]), 1e-6);
  limiter.freeze();
  gradients = IdVector<NodeId, Gradient>(dual.nodes(), Gradient{{8, 1, 0, 0}, {0, 0, 0, 0}});
  states = IdVector<NodeId, State>(dual.nodes(), State{1, 0, 0, 1});
  limiter.apply(states, gradients);
  EXPECT_LT(std::abs(gradients[middle].x[0]), 1e-6);  // kept from before
}

/// However little counts as small, since the mesh is coarse.
TEST(Limiter, LeavesDensityAndPressureAFifth) {
  const Mesh mesh = test::irregular_grid(8, {1, 1}, 0);
  const DualMesh dual(world(), mesh);
  const IdVector<NodeId, State> states(dual.nodes(), State{0.1, 1, 0, 0.01});
  IdVector<NodeId, Gradient> gradients(dual.nodes(), Gradient{{4, 4, 0, 4}, {0, 0, 0, 0}});
  Limiter(dual, 1e-3).apply(states, gradients);
  bool falls = false;
  for (const DualEdge& edge : dual.edges()) {
    for (const auto& [node, way] : {std::pair{edge.low, edge.half}, {edge.high, -1.0 * edge.half}}) {
      const double density = states[node][0] + gradients[node].x[0] * way.x,
                   pressure = states[node][3] + gradients[node].x[3] * way.x;
      EXPECT_GT(density, 0.0199);
      EXPECT_GT(pressure, 0.00199);
      falls = falls || pressure < 0.00201;
    }
    EXPECT_NEAR(gradients[edge.low].x[1], 4, 1e-7) << "a velocity may change its sign";
  }
  EXPECT_TRUE(falls);
}

TEST(Residual, OfALinearPressureIsExact) {
  for (const bool quads : {true, false}) {
    Mesh mesh = test::irregular_grid(10, {1, 2}, 0.24, quads);
    test::relabel(mesh, [](Point) { return "symmetry"; });
    EulerOptions options;
    options.limiter = EulerOptions::Limiter::none;
    const DualMesh dual(world(), mesh);
    const FlowModel model = flow_model(world(), mesh, options);
    Residual residual(dual, model, options);
    IdVector<NodeId, State> states;
    for (const Point p : mesh.points) states.push_back({1, 0, 0, 1 + 0.125 * p.x - 0.25 * p.y});
    const IdVector<NodeId, Flux>& sums = residual.evaluate(states);
    for (const NodeId node : states.ids()) {
      EXPECT_NEAR(sums[node][1], 0.125 * dual.areas()[node], 1e-15);
      EXPECT_NEAR(sums[node][2], -0.25 * dual.areas()[node], 1e-15);
    }
  }
}

TEST(Residual, ConservesWhateverTheFlowIs) {
  Mesh mesh = test::irregular_grid(10, {1, 1}, 0.2);
  test::relabel(mesh, [](Point) { return "symmetry"; });
  EulerOptions options;
  const DualMesh dual(world(), mesh);
  const FlowModel model = flow_model(world(), mesh, options);
  Residual residual(dual, model, options);
  IdVector<NodeId, State> states;
  for (int node = 0; node < mesh.owned_nodes; ++node) states.push_back(made_up_state(node));
  double mass = 0, energy = 0, largest = 0;
  for (const Flux& flux : residual.evaluate(states)) {
    mass += flux[0];
    energy += flux[3];
    largest = std::max(largest, std::abs(flux[3]));
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_NEAR(mass, 0, 1e-14);  // nothing goes through walls
  EXPECT_NEAR(energy, 0, 1e-14);
}

TEST(Vortex, BalancesItsPressureAndIsIsentropic) {
  const Gas gas;
  const Vortex vortex{gas, gas.free_stream(0.5, 20), {1, 2}, 1};
  const double step = 1e-5;
  for (const double r : {0.3, 1.0, 2.0}) {
    const auto at = [&](double radius) { return vortex.state({1 + radius, 2}, 0); };
    const State state = at(r);
    const double turning = state[2] - vortex.free_stream[2],
                 gradient = (at(r + step)[3] - at(r - step)[3]) / (2 * step);
    EXPECT_GT(turning, 0);
    EXPECT_NEAR(gradient, state[0] * turning * turning / r, 1e-8);
    EXPECT_NEAR(state[3] / std::pow(state[0], gas.gamma), 1 / gas.gamma, 1e-14);
  }
}

}  // namespace
}  // namespace quadloop::flow::euler
