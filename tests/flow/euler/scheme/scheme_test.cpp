// The parts of the scheme: the dual mesh closes, gradients are exact, fluxes are consistent and conserve,
// matrices are their derivatives.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/euler_options.hpp"
#include "flow/euler/scheme/flow_model.hpp"
#include "flow/euler/scheme/flux.hpp"
#include "flow/euler/scheme/flux_jacobian.hpp"
#include "flow/euler/scheme/gas.hpp"
#include "flow/euler/scheme/reconstruction.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::euler {
namespace {

using test::world;

State made_up_state(int number) {
  const auto part = [&](int which) { return test::scattered(3, number, which); };
  return {1 + 0.6 * part(0), 1.5 * part(1), 1.5 * part(2), 0.7 + 0.5 * part(3)};
}
Point made_up_normal(int number) {
  const double angle = 4 * test::scattered(4, number, 0);
  return {std::cos(angle), std::sin(angle)};
}

TEST(DualMesh, FillsTheMeshAndClosesRoundEachNode) {
  const Mesh mesh = test::irregular_grid(12, {3, 2}, 0.2);
  const DualMesh dual(world(), mesh);
  double area = 0;
  for (const double part : dual.areas()) area += part;
  EXPECT_NEAR(area, 6, 1e-12);
  std::vector<Point> sums(dual.nodes());
  for (const DualEdge& edge : dual.edges()) {
    EXPECT_LT(dual.global(edge.low), dual.global(edge.high));
    sums[edge.low] = sums[edge.low] + edge.size * edge.normal;
    sums[edge.high] = sums[edge.high] - edge.size * edge.normal;
  }
  for (const BoundaryFace& face : dual.faces()) {
    for (const std::int32_t node : {face.from, face.to}) {
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
  std::vector<State> states(dual.nodes());
  for (std::int32_t node = 0; node < dual.owned_nodes(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) states[node][k] = 1.0 + dot(slopes[k], dual.point(node));
  }
  std::vector<Gradient> gradients(dual.nodes());
  LeastSquares(dual).compute(states, gradients);
  const std::vector<Gradient> full = gradients;
  Limiter(dual, 1).apply(states, gradients);
  for (std::size_t node = 0; node < gradients.size(); ++node) {
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
  std::vector<State> states(dual.nodes(), State{1, 0, 0, 1});
  std::vector<Gradient> gradients(dual.nodes(), Gradient{{8, 0, 0, 0}, {0, 0, 0, 0}});
  const std::size_t middle = 40;
  states[middle][0] = 3;
  Limiter limiter(dual, 1e6);  // in units so large that nothing counts as small
  limiter.apply(states, gradients);
  EXPECT_LT(std::abs(gradients[middle].x[0]), 1e-6);
  limiter.freeze();
  gradients.assign(dual.nodes(), Gradient{{8, 1, 0, 0}, {0, 0, 0, 0}});
  states.assign(dual.nodes(), State{1, 0, 0, 1});
  limiter.apply(states, gradients);
  EXPECT_LT(std::abs(gradients[middle].x[0]), 1e-6);  // kept from before
}

TEST(RoeFlux, OfEqualStatesIsThePhysicalOne) {
  const Gas gas;
  for (int i = 0; i < 200; ++i) {
    const State state = made_up_state(i);
    const Point normal = made_up_normal(i);
    const Flux roe = roe_flux(gas, state, state, normal), physical = physical_flux(gas, state, normal);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(roe[k], physical[k], 1e-14);
  }
}

TEST(RoeFlux, IsTheSameFromTheOtherSide) {
  const Gas gas;
  for (int i = 0; i < 200; ++i) {
    const State left = made_up_state(2 * i), right = made_up_state(2 * i + 1);
    const Point normal = made_up_normal(i);
    const Flux forth = roe_flux(gas, left, right, normal),
               back = roe_flux(gas, right, left, {-normal.x, -normal.y});
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(forth[k], -back[k], 1e-13);
  }
}

TEST(RoeFlux, TakesAllFromUpwindFasterThanSound) {
  const Gas gas;
  const State left{1, 2.5, 0.3, 0.7}, right{1.3, 2.7, -0.2, 0.9};
  const Flux flux = roe_flux(gas, left, right, {1, 0}), upwind = physical_flux(gas, left, {1, 0});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(flux[k], upwind[k], 1e-13);
}

TEST(FluxChange, IsTheDerivativeOfTheFlux) {
  const Gas gas;
  for (int i = 0; i < 20; ++i) {
    const State state = made_up_state(2 * i), direction = made_up_state(2 * i + 1);
    const Point normal = 3.0 * made_up_normal(i);
    const double step = 1e-6;
    State up = state, down = state;
    for (std::size_t k = 0; k < 4; ++k) {
      up[k] += step * direction[k];
      down[k] -= step * direction[k];
    }
    const Flux more = physical_flux(gas, up, normal), less = physical_flux(gas, down, normal),
               change = flux_change(gas, state, direction, normal);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(change[k], (more[k] - less[k]) / (2 * step), 1e-7);
  }
}

TEST(FluxMatrix, IsTheDerivativeOfTheFlux) {
  const Gas gas;
  for (int i = 0; i < 20; ++i) {
    const State state = made_up_state(i);
    const Point normal = made_up_normal(i);
    Matrix4 matrix{};
    add_flux_matrix(gas, state, normal, 1, matrix);
    const Conserved w = gas.conserved(state);
    for (std::size_t column = 0; column < 4; ++column) {
      const double step = 1e-6;
      const auto moved = [&](double by) {
        return physical_flux(gas,
                             gas.state({w.mass + (column == 0) * by, w.x_momentum + (column == 1) * by,
                                        w.y_momentum + (column == 2) * by, w.energy + (column == 3) * by}),
                             normal);
      };
      const Flux up = moved(step), down = moved(-step);
      for (std::size_t row = 0; row < 4; ++row)
        EXPECT_NEAR(matrix[4 * row + column], (up[row] - down[row]) / (2 * step), 1e-7);
    }
  }
}

/// The pressure alone varies, linearly, in a gas at rest: each node's dual cell must feel exactly gradient
/// times area, on any mesh and at its boundary.
TEST(Residual, OfALinearPressureIsExact) {
  for (const bool quads : {true, false}) {
    Mesh mesh = test::irregular_grid(10, {1, 2}, 0.24, quads);
    test::relabel(mesh, [](Point) { return "symmetry"; });
    EulerOptions options;
    options.limiter = EulerOptions::Limiter::none;
    const DualMesh dual(world(), mesh);
    const FlowModel model = flow_model(world(), mesh, options);
    Residual residual(dual, model, options);
    std::vector<State> states;
    for (const Point p : mesh.points) states.push_back({1, 0, 0, 1 + 0.125 * p.x - 0.25 * p.y});
    const std::vector<Flux>& sums = residual.evaluate(states);
    for (std::size_t node = 0; node < states.size(); ++node) {
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
  std::vector<State> states;
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

TEST(FlowModel, RefusesAConditionThatItCannotUse) {
  Mesh mesh = test::irregular_grid(4, {1, 1}, 0);
  EulerOptions options;
  mesh.boundaries[1].condition = "interface";
  try {
    flow_model(world(), mesh, options);
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("[boundary.far] bc"), std::string::npos) << error.what();
  }
  options.boundaries = {{"far", "outflow", 0.5}};
  const FlowModel model = flow_model(world(), mesh, options);
  EXPECT_EQ(model.boundaries[1].condition, Condition::outflow);
  EXPECT_DOUBLE_EQ(*model.boundaries[1].pressure, 0.5 / 1.4);
  mesh.boundaries.push_back({"nothing", "none", {}});  // without edges it does no harm
  EXPECT_EQ(flow_model(world(), mesh, options).boundaries[2].condition, Condition::none);
}

/// The conditions of all words that a case may say, but those that the solver refuses.
std::map<std::string, Condition> usable_conditions() {
  Mesh mesh = test::irregular_grid(2, {1, 1}, 0);
  std::map<std::string, Condition> usable;
  for (const std::string& word : condition_words()) {
    for (BoundaryEdges& boundary : mesh.boundaries) boundary.condition = word;
    try {
      usable[word] = flow_model(world(), mesh, {}).boundaries[0].condition;
    } catch (const InputError&) {
      EXPECT_TRUE(word == "interface" || word == "none") << word;
    }
  }
  return usable;
}

TEST(FlowModel, HasAConditionForEachUsableWord) {
  const auto usable = usable_conditions();
  std::set<Condition> distinct;
  for (const auto& [word, condition] : usable) {
    distinct.insert(condition);
    EXPECT_EQ(feels_force(condition), word == "wall") << word;
  }
  EXPECT_EQ(distinct.size(), usable.size());
  EXPECT_EQ(usable.size(), 5U);
}

TEST(FlowModel, NothingFlowsThroughWallsAndPlanesOfSymmetry) {
  FlowModel model;
  model.free_stream = model.gas.free_stream(0.5, 0);
  for (const Condition condition : {Condition::wall, Condition::symmetry}) {
    const State state = made_up_state(1);
    const Flux flux = boundary_flux(model, {condition, {}}, state, {0.6, 0.8});
    EXPECT_EQ(flux, (Flux{0, 0.6 * state[3], 0.8 * state[3], 0}));
    Matrix4 matrix{};
    add_boundary_matrix(model, {condition, {}}, state, {0.6, 0.8}, 2, matrix);
    EXPECT_DOUBLE_EQ(matrix[7], 2 * 0.6 * (model.gas.gamma - 1));  // x momentum by energy
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(std::pair(matrix[k], matrix[12 + k]), std::pair(0.0, 0.0));
  }
}

TEST(FlowModel, RefusesAFaceOfABoundaryWithoutEdges) {
  const FlowModel model;
  Matrix4 matrix{};
  EXPECT_THROW(boundary_flux(model, {}, made_up_state(1), {1, 0}), Fault);
  EXPECT_THROW(add_boundary_matrix(model, {}, made_up_state(1), {1, 0}, 1, matrix), Fault);
  EXPECT_THROW(feels_force(Condition::none), Fault);
}

TEST(BoundaryFlux, OfTheFreeStreamIsPhysical) {
  FlowModel model;
  for (const double mach : {0.0, 0.5, 2.0}) {
    model.free_stream = model.gas.free_stream(mach, 30);
    for (const Condition condition : {Condition::farfield, Condition::inflow, Condition::outflow}) {
      for (int i = 0; i < 20; ++i) {
        const Point normal = made_up_normal(i);
        const Flux flux = boundary_flux(model, {condition, 1 / model.gas.gamma}, model.free_stream, normal);
        const Flux physical = physical_flux(model.gas, model.free_stream, normal);
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(flux[k], physical[k], 1e-14);
      }
    }
  }
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
}  // namespace quadloop::euler
