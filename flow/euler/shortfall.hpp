#pragma once

#include <string>

#include "flow/euler/solve_euler.hpp"

namespace quadloop {

/// What a run that did not converge came to, and what helps: one line for the user, without a full stop.
std::string shortfall(const EulerResult& result, const EulerOptions& options);
/// The same of a goal's adjoint.
std::string shortfall(const GoalValue& goal);

}  // namespace quadloop
