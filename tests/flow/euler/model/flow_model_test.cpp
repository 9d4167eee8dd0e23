// Fluxes between nodes are consistent and their matrices are derivatives; boundaries do what their conditions
// say.
#include "flow/euler/model/flow_model.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "flow/euler/model/euler_options.hpp"
#include "flow/euler/model/flux.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/model/gas.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/flow/euler/made_up_states.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::made_up_normal;
using test::made_up_state;
using test::world;

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

/// What a jump of speed along the normal puts into the flux of momentum beyond the mean of both sides.
double damped(double mach, double least_mach) {
  Gas gas;
  gas.least_mach = least_mach;
  const double jump = 1e-3 * mach;
  const State left{1, mach - jump, 0, 1 / gas.gamma}, right{1, mach + jump, 0, 1 / gas.gamma};
  const Flux flux = roe_flux(gas, left, right, {1, 0});
  return (0.5 * (physical_flux(gas, left, {1, 0})[1] + physical_flux(gas, right, {1, 0})[1]) - flux[1]) /
         jump;
}

TEST(RoeFlux, DampsAJumpOfSpeedAsTheFlowsMachNumberSays) {
  EXPECT_NEAR(damped(0.01, 1), 1, 0.05);
  EXPECT_NEAR(damped(0.01, 0.005), 0.01, 0.02);
  EXPECT_NEAR(damped(0.01, 0.1) / damped(0.01, 1), 0.1, 0.03) << "no less than the free stream's";
  EXPECT_EQ(damped(1.5, 0.3), damped(1.5, 1)) << "faster than sound";
}

/// Roe's flux takes more gas out of a vacuum than there is where speeds are damped by little.
TEST(RoeFlux, DampsSpeedsInFullWherePressureJumps) {
  Gas slow;
  slow.least_mach = 0.1;
  const State gas{1, 0, 0, 1 / slow.gamma}, vacuum{0.05, -0.3, 0, 0.02};
  const Flux flux = roe_flux(slow, gas, vacuum, {1, 0}), whole = roe_flux(Gas{}, gas, vacuum, {1, 0});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(flux[k], whole[k]);
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
TEST(FlowModel, RefusesAConditionThatItCannotUse) {
  Mesh mesh = test::irregular_grid(4, {1, 1}, 0);
  EulerOptions options;
  mesh.boundaries[1].condition = BoundaryCondition::interface;
  try {
    flow_model(world(), mesh, options);
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("in [boundary.far] set bc to"), std::string::npos)
        << error.what();
  }
  mesh.boundaries[0].condition = BoundaryCondition::none;
  try {
    flow_model(world(), mesh, options);
    FAIL() << "taken";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("'wall' has no condition, 'far' has the condition 'interface'"), std::string::npos)
        << what;
    EXPECT_NE(what.find("in [boundary.wall], [boundary.far] set bc to"), std::string::npos) << what;
  }
  mesh.boundaries[0].condition = BoundaryCondition::wall;
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
  for (const auto& [name, condition] : values_of_bc()) {
    const std::string word = name;
    for (BoundaryEdges& boundary : mesh.boundaries) boundary.condition = condition;
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

/// Gas at rest that meets a vacuum leaves with the speed of sound that its fan has there.
TEST(BoundaryFlux, ThroughAnOutflowWithoutPressureIsNeverSlowerThanSound) {
  const FlowModel model;
  const BoundaryModel open{Condition::outflow};
  const State rest{1, 0, 0, 1 / 1.4};
  const double sound = 2 / 2.4;
  const Flux flux = boundary_flux(model, open, rest, Point{1, 0});
  EXPECT_NEAR(flux[0], std::pow(sound, 6), 1e-14);
  EXPECT_NEAR(flux[1], std::pow(sound, 7) * (1 + 1 / 1.4), 1e-14);
  const auto mass = [&](double speed) {
    return boundary_flux(model, open, State{1, 0.6 * speed, 0.8 * speed, 1 / 1.4}, Point{0.6, 0.8})[0];
  };
  EXPECT_NEAR(mass(1 - 1e-9), mass(1 + 1e-9), 1e-8);
  EXPECT_EQ(mass(1.5), 1.5);
  for (double speed = -20; speed < 1; speed += 0.25) EXPECT_GT(mass(speed), 0) << speed;
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

}  // namespace
}  // namespace quadloop::flow::euler
