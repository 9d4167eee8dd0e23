// Adjoints of converged flows against flows solved anew.
#include "flow/adjoint/estimate_goals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

struct Flow {
  EulerResult result;
  const GoalValue& goal(std::size_t k) const { return result.goals.at(k); }
};

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
  constexpr double d = 1e-3;
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

TEST(EstimateGoals, DerivativesAreThoseOfFlowsSolvedAnew) {
  EulerOptions options = of_ellipse(0.4, 2);
  options.goals.push_back({Goal::Quantity::moment, {}, {0.2, 0.1}});
  options.goals.push_back({Goal::Quantity::pressure, {"wall"}});
  expect_derivatives(test::ring_mesh(48, 24, 0.3, 10), options, 1e-4);
}

}  // namespace
}  // namespace quadloop
