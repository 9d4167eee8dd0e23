#pragma once

#include <string>
#include <vector>

#include "flow/euler/solve_euler.hpp"

namespace quadloop {

/// What a run that did not converge came to, and what helps: one line for the user, without a full stop.
std::string shortfall(const EulerResult& result, const EulerOptions& options);
/// The same of a goal's adjoint.
std::string shortfall(const GoalValue& goal);
/// All that a run did not come to, its goals too; of a mean over time but what line_of() tells of it.
std::vector<std::string> shortfalls(const EulerResult& result, const EulerOptions& options);

}  // namespace quadloop
