#pragma once

#include <string>
#include <vector>

#include "flow/euler/solve_euler.hpp"

namespace quadloop::flow {

/// Returns one line for the user, without a full stop: the state of a run that did not converge, and a
/// remedy.
std::string shortfall(const EulerResult& result, const EulerOptions& options);
/// The same for the adjoint of an output functional.
std::string shortfall(const GoalValue& goal);
/// Returns these lines for the run and its functionals; for a time average only what line_of() does not
/// report.
std::vector<std::string> shortfalls(const EulerResult& result, const EulerOptions& options);

}  // namespace quadloop::flow
