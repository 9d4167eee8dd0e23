// The residual's derivative against differences, and its transpose against itself.
#include "flow/adjoint/linear_residual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "flow/adjoint/place_derivative.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/flow/adjoint/adjoint_run.hpp"

namespace quadloop::flow::euler {
namespace {

using test::AdjointRun;
using test::world;

EulerOptions options_at(double mach) {
  EulerOptions options;
  options.mach = mach;
  options.alpha = 3;
  options.boundaries = {{"wall", "wall", {}}, {"far", "farfield", {}}};
  return options;
}

double dot(const FlowRun& run, const IdVector<NodeId, State>& a, const IdVector<NodeId, State>& b) {
  std::vector<double> terms;
  for (const NodeId node : run.mesh.owned_ids()) {
    for (std::size_t k = 0; k < 4; ++k) terms.push_back(a[node][k] * b[node][k]);
  }
  return reproducible_sum(run.comm, terms);
}

/// The largest of what the derivative along a direction is off from central differences, over the largest of
/// them.
double worst_difference(AdjointRun& made, const IdVector<NodeId, State>& direction, double step) {
  const LinearResidual linear(made.run);
  IdVector<NodeId, State> change = direction;
  IdVector<NodeId, Flux> slope;
  linear.apply(change, slope);
  const IdVector<NodeId, State> held = made.states;
  const auto at = [&](double share) {
    for (const NodeId node : held.ids()) {
      for (std::size_t k = 0; k < 4; ++k)
        made.states[node][k] = held[node][k] + share * step * direction[node][k];
    }
    return IdVector<NodeId, Flux>(made.residual.evaluate(made.states));
  };
  const IdVector<NodeId, Flux> up = at(1), down = at(-1);
  made.states = held;
  double worst = 0, largest = 0;
  for (const NodeId node : made.dual.owned_ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double difference = (up[node][k] - down[node][k]) / (2 * step);
      worst = std::max(worst, std::abs(difference - slope[node][k]));
      largest = std::max(largest, std::abs(difference));
    }
  }
  return made.run.comm.maximum(worst) / made.run.comm.maximum(largest);
}

void expect_transposed(AdjointRun& made) {
  const LinearResidual linear(made.run);
  IdVector<NodeId, State> w = made.made_up(11), transposed;
  IdVector<NodeId, Flux> v = made.made_up(12), product;
  linear.apply(w, product);
  linear.apply_transposed(v, transposed);
  const double there = dot(made.run, v, product), back = dot(made.run, transposed, w);
  const double size = std::sqrt(dot(made.run, v, v) * dot(made.run, product, product));
  EXPECT_NEAR(there, back, 1e-15 * size);
  EXPECT_GT(size, 0);
}

TEST(LinearResidual, IsTheDerivativeWithTheLimiter) {
  for (const double mach : {0.5, 0.9, 2.0}) {
    AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options_at(mach));
    const IdVector<NodeId, State> direction = made.made_up(3);
    EXPECT_LT(worst_difference(made, direction, 1e-7), 1e-6) << mach;
  }
}

/// Pressures of neighbours that differ up to threefold.
TEST(LinearResidual, IsTheDerivativeBesideStrongShocks) {
  AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options_at(2.0), 0.5);
  const IdVector<NodeId, State> direction = made.made_up(3);
  EXPECT_LT(worst_difference(made, direction, 1e-7), 1e-6);
  bool live = false;
  for (const NodeId node : made.dual.owned_ids()) {
    const double share = shock_share(made.residual.shocks()->jump(node));
    live = live || (share > 0.1 && share < 0.9);
  }
  EXPECT_TRUE(made.run.comm.any(live));
  expect_transposed(made);
}

/// Where the mesh is so coarse that bounds count for nothing, what density and pressure must keep decides.
TEST(LinearResidual, IsTheDerivativeWhereLittlePressureIsLeft) {
  EulerOptions options = options_at(0.8);
  options.reference_length = 1e-3;
  AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options, 0.95);
  const IdVector<NodeId, State> direction = made.made_up(3);
  EXPECT_LT(worst_difference(made, direction, 1e-8), 1e-6);
  made.residual.evaluate(made.states);
  bool decides = false;
  for (const auto& factors : made.residual.limiter()->factors())
    decides = decides || factors[0] < 0.9 || factors[3] < 0.9;
  EXPECT_TRUE(made.run.comm.any(decides));
  expect_transposed(made);
}

TEST(LinearResidual, IsTheDerivativeWhereFactorsAreKept) {
  AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options_at(0.8));
  made.residual.evaluate(made.states);
  made.residual.freeze_limiter();
  const IdVector<NodeId, State> direction = made.made_up(3);
  EXPECT_LT(worst_difference(made, direction, 1e-6), 1e-8);
}

TEST(LinearResidual, IsTheDerivativeWithoutLimiterAndOnEachBoundary) {
  EulerOptions options = options_at(0.6);
  options.limiter = EulerOptions::Limiter::none;
  for (const BoundaryCondition condition : {BoundaryCondition::farfield, BoundaryCondition::inflow,
                                            BoundaryCondition::outflow, BoundaryCondition::symmetry}) {
    for (const std::optional<double> pressure : {std::optional(0.9), std::optional<double>()}) {
      options.boundaries[1] = {"far", condition, pressure};
      AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options);
      const IdVector<NodeId, State> direction = made.made_up(4);
      EXPECT_LT(worst_difference(made, direction, 1e-6), 1e-8) << condition.word();
    }
  }
}

TEST(LinearResidual, TheTransposeIsTheTranspose) {
  for (const double mach : {0.5, 0.9, 2.0}) {
    for (const bool kept : {false, true}) {
      AdjointRun made(world(), test::irregular_grid(9, {1, 1}, 0.2), options_at(mach));
      made.residual.evaluate(made.states);
      if (kept) made.residual.freeze_limiter();
      expect_transposed(made);
    }
  }
  AdjointRun ring(world(), test::ring_mesh(24, 8, 0.3, 5), [] {
    EulerOptions options;
    options.limiter = EulerOptions::Limiter::none;
    return options;
  }());
  expect_transposed(ring);
}

/// A made-up adjoint times the residual, of made-up states on a moved mesh; the goal is held.
struct PlaceCase {
  PlaceCase(const EulerOptions& options, bool keeps) : options_{options}, keeps_{keeps} {}

  Mesh moved(double by) const {
    Mesh mesh = test::irregular_grid(9, {1, 1}, 0.2);
    for (Point& p : mesh.points) p = p + by * way(p);
    return mesh;
  }
  static Point way(Point p) { return {0.3 + p.y - p.x * p.x, 0.5 * std::sin(3 * p.x) - p.y}; }

  double product(double by) const {
    AdjointRun made(world(), moved(by), options_);
    if (keeps_) made.residual.freeze_limiter();  // of factors 1
    return dot(made.run, made.made_up(5), made.residual.evaluate(made.states));
  }
  /// As place_derivative() has it, but for the goal's part.
  double derivative(const Goal& goal) const {
    AdjointRun made(world(), moved(0), options_);
    if (keeps_) made.residual.freeze_limiter();
    const LinearResidual linear(made.run);
    const GoalFunctional functional(made.run.comm, made.dual, made.model, made.names, goal, 1);
    IdVector<NodeId, Point> of_goal(made.dual.nodes());
    functional.add_place_derivative(made.states, of_goal);
    const IdVector<NodeId, Point> all = place_derivative(linear, functional, made.made_up(5));
    std::vector<double> terms;
    for (const NodeId node : made.dual.owned_ids())
      terms.push_back(dot_of(way(made.dual.point(node)), of_goal[node] - all[node]));
    return reproducible_sum(made.run.comm, terms);
  }
  double goal(const Goal& goal, double by) const {
    const AdjointRun made(world(), moved(by), options_);
    return GoalFunctional(made.run.comm, made.dual, made.model, made.names, goal, 1).value(made.states);
  }
  double goal_derivative(const Goal& goal) const {
    const AdjointRun made(world(), moved(0), options_);
    const GoalFunctional functional(made.run.comm, made.dual, made.model, made.names, goal, 1);
    IdVector<NodeId, Point> sums(made.dual.nodes());
    functional.add_place_derivative(made.states, sums);
    std::vector<double> terms;
    for (const NodeId node : made.dual.owned_ids())
      terms.push_back(dot_of(way(made.dual.point(node)), sums[node]));
    return reproducible_sum(made.run.comm, terms);
  }
  static double dot_of(Point a, Point b) { return a.x * b.x + a.y * b.y; }

  EulerOptions options_;
  bool keeps_;
};

TEST(PlaceDerivative, OfTheResidualIsThatOfMovedMeshes) {
  for (const double mach : {0.6, 1.5}) {
    for (const bool keeps : {true, false}) {
      const PlaceCase made(options_at(mach), keeps);
      constexpr double d = 1e-6;
      const double here = made.product(0), ahead = (made.product(d) - here) / d,
                   behind = (here - made.product(-d)) / d, found = made.derivative({});
      // where largest values of neighbours are equal the limiter has a kink: then the two differ
      const double tolerance = keeps ? 1e-6 * std::abs(ahead) : 2e-5 * std::abs(ahead);
      EXPECT_GT(found, std::min(ahead, behind) - tolerance) << mach << keeps;
      EXPECT_LT(found, std::max(ahead, behind) + tolerance) << mach << keeps;
      EXPECT_LT(std::abs(ahead - behind), 5e-5 * std::abs(ahead));
      EXPECT_GT(std::abs(ahead), 0.01);
    }
  }
}

TEST(PlaceDerivative, OfGoalsIsThatOfMovedMeshes) {
  const PlaceCase made(options_at(0.6), true);
  for (const auto& [word, quantity] : Goal::words) {
    const Goal goal{quantity, {}, {0.3, 0.2}};
    constexpr double d = 1e-6;
    const double difference = (made.goal(goal, d) - made.goal(goal, -d)) / (2 * d);
    EXPECT_NEAR(made.goal_derivative(goal), difference, 1e-7 * std::abs(difference)) << word;
  }
}

TEST(LinearResidual, HasTheSameBitsOnAnyNumberOfRanks) {
  const Mesh whole = test::irregular_grid(9, {1, 1}, 0.2);
  const Communicator self(MPI_COMM_SELF);
  AdjointRun part(world(), whole, options_at(0.8)), all(self, whole, options_at(0.8));
  const auto products = [](AdjointRun& made) {
    const LinearResidual linear(made.run);
    IdVector<NodeId, State> w = made.made_up(11), transposed;
    IdVector<NodeId, Flux> v = made.made_up(12), product;
    linear.apply(w, product);
    linear.apply_transposed(v, transposed);
    return std::pair{product, transposed};
  };
  const auto here = products(part), alone = products(all);
  for (const NodeId node : part.dual.owned_ids()) {
    const NodeId of_all{static_cast<std::int32_t>(part.dual.global(node).value())};
    EXPECT_EQ(here.first[node], alone.first[of_all]);
    EXPECT_EQ(here.second[node], alone.second[of_all]);
  }
}

}  // namespace
}  // namespace quadloop::flow::euler
