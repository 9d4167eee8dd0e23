#pragma once

#include "flow/euler/model/euler_options.hpp"
#include "io/input/case_file.hpp"

namespace quadloop {

/// What [solver] says of goals: `goal`, `goal_on`, `goal_about`, `goal_adjoint`. Boundaries are patterns
/// still. Throws InputError that names key and line; `built_in` tells whether the solver is the built-in one,
/// which alone has goals. The other options must have been read.
void read_goals(const CaseTable& table, bool built_in, EulerOptions& options);

/// The goals with the names of boundaries that their patterns match. Throws InputError for a pattern that
/// matches none.
std::vector<Goal> goals_on(const std::vector<Goal>& goals, const std::vector<std::string>& boundaries);

}  // namespace quadloop
