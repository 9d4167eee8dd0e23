#include "flow/euler/shortfall.hpp"

#include <fmt/format.h>

namespace quadloop {

std::string shortfall(const EulerResult& result, const EulerOptions& options) {
  if (options.time == EulerOptions::Time::accurate) {
    return fmt::format("time {:.6g} of {:.6g} was reached in {} steps; raise solver.iterations", result.time,
                       options.end_time, result.iterations);
  }
  if (!result.failed_in_time.empty()) {
    return fmt::format(
        "the flow could not be carried on in time ({}); the steady flow of step {} is kept, with a residual "
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
      "the residual fell to {:.2e} of the larger of the start's and the free stream's in {} steps, not to "
      "the tolerance {:.2e}",
      result.residual, result.iterations, options.tolerance);
  if (!result.stalled) return fell + "; raise solver.iterations";
  return fell +
         ", and hardly at all in the second half of them; more steps do not help: raise solver.tolerance or "
         "try a smaller solver.cfl";
}

std::string shortfall(const GoalValue& goal) {
  return fmt::format(
      "the adjoint of {} was solved to {:.2e} in {} steps; its error is a guess where the flow has not "
      "converged: lower solver.tolerance, raise solver.iterations",
      goal.name, goal.residual, goal.iterations);
}

std::vector<std::string> shortfalls(const EulerResult& result, const EulerOptions& options) {
  std::vector<std::string> lines;
  if (!result.converged) lines.push_back(shortfall(result, options));
  if (result.unsolved > 0 && !result.unsteady)
    lines.push_back(
        fmt::format("{} of {} implicit steps in time were not solved to the tolerance: try a "
                    "smaller solver.time_step",
                    result.unsolved, result.iterations));
  for (const GoalValue& goal : result.goals) {
    if (!goal.converged) lines.push_back(shortfall(goal));
  }
  return lines;
}

}  // namespace quadloop
