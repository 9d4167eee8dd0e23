#pragma once

#include <string>
#include <vector>

#include "flow/euler/model/euler_options.hpp"
#include "quadloop/case/solver_settings.hpp"

namespace quadloop {

/// What [solver] says of goals, rows of its table.
std::vector<Key<SolverSettings>> goal_keys();

/// Makes the goals with their boundaries, which are patterns still, and the point of moments. Throws
/// InputError that names key and line.
void place_goals(const CaseTable& table, SolverSettings& settings);

/// The goals with the names of boundaries that their patterns match. Throws InputError for a pattern that
/// matches none.
std::vector<Goal> goals_on(const std::vector<Goal>& goals, const std::vector<std::string>& boundaries);

}  // namespace quadloop
