#include "flow/euler/shortfall.hpp"

#include <fmt/format.h>

namespace quadloop {

std::string shortfall(const EulerResult& result, const EulerOptions& options) {
  if (options.time == EulerOptions::Time::accurate) {
    return fmt::format("time {:.6g} of {:.6g} was reached in {} steps; raise solver.iterations", result.time,
                       options.end_time, result.iterations);
  }
  if (result.time > 0) {
    return fmt::format(
        "the flow found no steady state (residual {:.2e}) and was carried on in time by {:.6g}: over the "
        "second half "
        "of that CL is {:.6f}, give or take {:.6f}, and CD {:.6f}, give or take {:.6f}",
        result.residual, result.time, result.cl, result.cl_swing, result.cd, result.cd_swing);
  }
  if (result.kept_iteration < result.iterations) {
    return fmt::format(
        "the residual fell to {:.2e} at step {} and then rose to {:.2e}; the flow at step {} is kept. It may "
        "have no steady state: close blunt "
        "trailing "
        "edges, try a smaller solver.cfl, set solver.unsteady_time, or solver.tolerance to what was reached",
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

}  // namespace quadloop
