// Adjoints of converged flows against flows solved anew.
#include "flow/adjoint/estimate_goals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flow/adjoint/parameter_derivative.hpp"
#include "flow/adjoint/solve_adjoint.hpp"
#include "flow/euler/march.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/adjoint/adjoint_run.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

EulerOptions of_ellipse(double mach, double alpha) {
  EulerOptions options;
  options.mach = mach;
  options.alpha = alpha;
  options.tolerance = 1e-13;
  options.iterations = 600;
  options.goals = {{Goal::Quantity::lift}, {Goal::Quantity::drag}};
  return options;
}

EulerResult solved(const Communicator& comm, const Mesh& whole, const EulerOptions& options,
                   const Field& start = {}) {
  const Mesh mesh = scatter_mesh(comm, whole, space_filling_order(whole));
  return solve_euler(comm, mesh, options, start, estimate_goals(options));
}

/// dJ/d(alpha) and dJ/d(mach) of all goals against central differences of flows that start from this one.
void expect_derivatives(const Mesh& mesh, const EulerOptions& options, double tolerance) {
  const EulerResult flow = solved(world(), mesh, options);
  const auto at = [&](double mach, double alpha) {
    EulerOptions other = options;
    other.mach = mach;
    other.alpha = alpha;
    return solved(world(), mesh, other, flow.flow).goals;
  };
  constexpr double d = 2e-4;
  const auto more = at(options.mach, options.alpha + d), less = at(options.mach, options.alpha - d),
             faster = at(options.mach + d, options.alpha), slower = at(options.mach - d, options.alpha);
  for (std::size_t k = 0; k < options.goals.size(); ++k) {
    const GoalValue& goal = flow.goals.at(k);
    EXPECT_LE(goal.residual, 1e-8) << goal.name;
    const double by_alpha = (more[k].value - less[k].value) / (2 * d),
                 by_mach = (faster[k].value - slower[k].value) / (2 * d);
    EXPECT_NEAR(goal.by_alpha, by_alpha, tolerance * std::abs(by_alpha)) << goal.name;
    EXPECT_NEAR(goal.by_mach, by_mach, tolerance * std::abs(by_mach)) << goal.name;
  }
}

/// No body has its lift decided by a flow without viscosity but by its trailing edge; a bump in a channel
/// has.
Mesh bump_mesh(std::int32_t n) {
  Mesh mesh = test::wedge_mesh(n, 0);
  for (Point& p : mesh.points) {
    const double along = p.x - 0.75;
    p.y += (1 - p.y) * 0.05 * std::exp(-40 * along * along);
  }
  return mesh;
}

EulerOptions over_bump() {
  EulerOptions options = of_ellipse(0.5, 0);
  options.limiter = EulerOptions::Limiter::none;
  options.boundaries = {{"outflow", "outflow", 1.0}};
  options.goals.push_back({Goal::Quantity::moment, {}, {0.2, 0.1}});
  options.goals.push_back({Goal::Quantity::pressure, {"wall"}});
  return options;
}

TEST(EstimateGoals, DerivativesAreThoseOfFlowsSolvedAnew) {
  expect_derivatives(bump_mesh(24), over_bump(), 1e-5);
}

/// A flow that goes on from one free stream to another with the limiter's factors held.
struct HeldFlow {
  HeldFlow(const Mesh& mesh, const EulerOptions& options) : made{world(), mesh, options} {
    std::ranges::fill(made.states, made.model.free_stream);
    march_to_steady(made.run);
    made.residual.freeze_limiter();
    march_to_steady(made.run);
  }
  double lift_at(double mach, double alpha) {
    made.model.free_stream = made.model.gas.free_stream(mach, alpha);
    made.model.gas.least_mach = std::min(mach, 1.0);
    march_to_steady(made.run);
    return functional().value(made.states);
  }
  euler::GoalFunctional functional() const {
    return {world(), made.dual, made.model, made.names, goal, made.options.reference_length};
  }

  test::AdjointRun made;
  Goal goal{Goal::Quantity::lift};
};

/// With a shock the flow hangs on the limiter, which is not smooth, and on which of its factors are kept.
void expect_derivatives_of_held(const Mesh& mesh, const EulerOptions& options) {
  HeldFlow flow(mesh, options);
  const euler::LinearResidual linear(flow.made.run);
  const euler::Adjoint adjoint = solve_adjoint(linear, flow.functional().derivative());
  EXPECT_LE(adjoint.residual, 1e-8);
  const auto found = parameter_derivative(flow.made.run, flow.made.names, flow.goal, adjoint.weights);
  constexpr double d = 1e-5;
  const double mach = options.mach, alpha = options.alpha;
  const double by_alpha = (flow.lift_at(mach, alpha + d) - flow.lift_at(mach, alpha - d)) / (2 * d),
               by_mach = (flow.lift_at(mach + d, alpha) - flow.lift_at(mach - d, alpha)) / (2 * d);
  EXPECT_NEAR(found.by_alpha, by_alpha, 1e-4 * std::abs(by_alpha));
  EXPECT_NEAR(found.by_mach, by_mach, 1e-4 * std::abs(by_mach));
}

TEST(EstimateGoals, DerivativesHoldAtShocksWhereFactorsAreHeld) {
  EulerOptions wedge;
  wedge.mach = 2;
  wedge.tolerance = 1e-13;
  wedge.iterations = 400;
  expect_derivatives_of_held(test::wedge_mesh(24, 10), wedge);
  EulerOptions bump = over_bump();
  bump.mach = 0.72;  // a shock stands behind the top
  bump.limiter = EulerOptions::Limiter::venkatakrishnan;
  expect_derivatives_of_held(bump_mesh(32), bump);
}

std::vector<double> column(const EulerResult& result, const std::string& name) {
  const auto at = std::ranges::find(result.flow.names, name);
  EXPECT_NE(at, result.flow.names.end()) << name;
  return result.flow.column(at - result.flow.names.begin());
}

/// A smooth motion of the plane that ends far from the body.
Point motion(Point p) {
  const double near = std::exp(-dot(p, p));
  return {near * (0.3 + p.y), near * (0.5 * p.x - p.x * p.y)};
}

/// How goals answer to moved nodes: against central differences of flows on meshes so moved.
void expect_place_derivatives(const Mesh& mesh, EulerOptions options, double tolerance) {
  options.adjoint_fields = true;
  const Communicator self(MPI_COMM_SELF);
  const EulerResult flow = solved(self, mesh, options);
  options.adjoint_fields = false;
  constexpr double d = 1e-5;
  const auto moved = [&](double by) {
    Mesh other = mesh;
    for (Point& p : other.points) p = p + by * motion(p);
    return solved(self, other, options, flow.flow).goals;
  };
  const auto more = moved(d), less = moved(-d);
  const Mesh ordered = scatter_mesh(self, mesh, space_filling_order(mesh));
  for (std::size_t k = 0; k < options.goals.size(); ++k) {
    const std::string name = flow.goals[k].name;
    const std::vector<double> by_x = column(flow, name + "_by_x"), by_y = column(flow, name + "_by_y");
    double sum = 0;
    for (std::size_t node = 0; node < by_x.size(); ++node)
      sum += dot(motion(ordered.points[node]), {by_x[node], by_y[node]});
    const double difference = (more[k].value - less[k].value) / (2 * d);
    EXPECT_NEAR(sum, difference, tolerance * std::abs(difference)) << name;
    EXPECT_GT(std::abs(difference), 1e-3) << name;
  }
}

TEST(EstimateGoals, NodesThatMoveDoWhatTheyDoToFlowsSolvedAnew) {
  expect_place_derivatives(bump_mesh(24), over_bump(), 1e-5);
}

TEST(EstimateGoals, AShockIsNoHindranceWhereFactorsAreKept) {
  EulerOptions options;
  options.mach = 2;
  options.tolerance = 1e-13;
  options.iterations = 600;
  options.goals = {{Goal::Quantity::drag}};
  const EulerResult flow = solved(world(), test::wedge_mesh(36, 10), options);
  EXPECT_LE(flow.goals.at(0).residual, 1e-8);
  EXPECT_NEAR(flow.goals[0].corrected, flow.goals[0].value, 2 * flow.goals[0].error);
}

/// Corrected values are nearer to those of a fine mesh, whose own error is a ninth.
TEST(EstimateGoals, CorrectedDragIsNearerToThatOfAFineMesh) {
  EulerOptions options = of_ellipse(0.4, 0);
  options.tolerance = 1e-10;
  options.goals = {{Goal::Quantity::drag}};
  const GoalValue coarse = solved(world(), test::ring_mesh(32, 16, 0.3, 10), options).goals[0],
                  fine = solved(world(), test::ring_mesh(96, 48, 0.3, 10), options).goals[0];
  EXPECT_LT(std::abs(coarse.corrected - fine.value), 0.5 * std::abs(coarse.value - fine.value))
      << coarse.value << " " << coarse.corrected << " " << fine.value << " " << fine.corrected;
  EXPECT_GT(coarse.error, 0.5 * std::abs(coarse.value - fine.value));
  EXPECT_LT(fine.error, coarse.error / 3);
}

TEST(EstimateGoals, RefusesWhatHasNoAdjoint) {
  EulerOptions viscous = of_ellipse(0.4, 0), unsteady = viscous, resting = viscous, elsewhere = viscous;
  viscous.viscosity = 1e-3;
  EXPECT_THROW(estimate_goals(viscous), InputError);
  unsteady.time = EulerOptions::Time::accurate;
  EXPECT_THROW(estimate_goals(unsteady), InputError);
  resting.mach = 0;
  resting.iterations = elsewhere.iterations = 0;
  EXPECT_THROW(solved(world(), test::ring_mesh(8, 4, 0.3, 4), resting), InputError);
  elsewhere.goals[0].boundaries = {"flap"};
  EXPECT_THROW(solved(world(), test::ring_mesh(8, 4, 0.3, 4), elsewhere), InputError);
  viscous.goals.clear();
  EXPECT_FALSE(estimate_goals(viscous)) << "nothing to do";
}

}  // namespace
}  // namespace quadloop::flow
