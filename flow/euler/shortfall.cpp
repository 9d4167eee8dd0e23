#include "flow/euler/shortfall.hpp"

#include <fmt/format.h>

namespace quadloop::flow {

std::string shortfall(const EulerResult& result, const EulerOptions& options) {
  if (options.time == EulerOptions::Time::accurate) {
    return fmt::format("time {:.6g} of {:.6g} was reached in {} steps; increase solver.iterations",
                       result.time, options.end_time, result.iterations);
  }
  if (!result.failed_in_time.empty()) {
    return fmt::format(
        "the flow could not be continued in time ({}); the steady flow of step {} is kept, with a residual "
        "of {:.2e}, not the tolerance {:.2e}",
        result.failed_in_time, result.kept_iteration, result.residual, options.tolerance);
  }
  if (!result.failed_as_steady.empty()) {
    return fmt::format("{}; the flow of step {} is kept, with a residual of {:.2e}, not the tolerance {:.2e}",
                       result.failed_as_steady, result.kept_iteration, result.residual, options.tolerance);
  }
  if (result.kept_iteration < result.iterations) {
    return fmt::format(
        "the residual fell to {:.2e} at step {} and then rose to {:.2e}; the flow at step {} is kept. It may "
        "have no steady state: close blunt "
        "trailing "
        "edges, try a smaller solver.cfl, or set solver.tolerance to what was reached",
        result.residual, result.kept_iteration, result.last_residual, result.kept_iteration);
  }
  const std::string fell = fmt::format(
      "the residual fell to {:.2e} of the larger of those of the initial flow and the free stream in {} "
      "steps, not to the tolerance {:.2e}",
      result.residual, result.iterations, options.tolerance);
  if (!result.stalled) return fell + "; increase solver.iterations";
  return fell +
         ", and hardly at all in the second half of them; more steps do not help: increase solver.tolerance, "
         "or try a smaller solver.cfl";
}

std::string shortfall(const GoalValue& goal) {
  return fmt::format(
      "the adjoint of {} was solved to {:.2e} in {} steps; its error estimate is unreliable unless the flow "
      "has converged: reduce solver.tolerance, or increase solver.iterations",
      goal.name, goal.residual, goal.iterations);
}

std::vector<std::string> shortfalls(const EulerResult& result, const EulerOptions& options) {
  std::vector<std::string> lines;
  if (!result.converged) lines.push_back(shortfall(result, options));
  if (result.unsolved > 0 && !result.unsteady)
    lines.push_back(fmt::format(
        "{} of {} implicit time steps did not converge to the tolerance: try a smaller solver.time_step",
        result.unsolved, result.iterations));
  for (const GoalValue& goal : result.goals) {
    if (!goal.converged) lines.push_back(shortfall(goal));
  }
  return lines;
}

}  // namespace quadloop::flow
