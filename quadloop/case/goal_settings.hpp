#pragma once

#include <string>
#include <vector>

#include "flow/euler/model/euler_options.hpp"
#include "quadloop/case/solver_settings.hpp"

namespace quadloop {

/// Returns the keys of [solver] for output functionals, as rows of its table.
std::vector<Key<SolverSettings>> goal_keys();

/// Creates the functionals with their boundaries, which are still patterns, and the reference point of
/// moments. Throws InputError that names key and line.
void place_goals(const io::CaseTable& table, SolverSettings& settings);

/// Replaces the patterns of the functionals by the names of the matching boundaries. Throws InputError for a
/// pattern that matches none.
std::vector<flow::Goal> goals_on(const std::vector<flow::Goal>& goals,
                                 const std::vector<std::string>& boundaries);

}  // namespace quadloop
