#include "quadloop/case/goal_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"

namespace quadloop {

namespace {

/// A word, a list of words, or a table of words with the weights of their errors.
std::vector<Goal> read_quantities(const CaseTable& table) {
  std::vector<Goal> goals;
  if (table.is_table("goal")) {
    const CaseTable weights = *table.table("goal");
    for (const auto& [word, quantity] : Goal::words) {
      if (const auto weight = weights.number(word, Range::positive()))
        goals.push_back({quantity, {}, {}, *weight});
    }
    weights.finish();
  } else {
    for (const std::string& word : table.texts("goal")) {
      const auto quantity = value_of(Goal::words, word);
      const auto is_same = [&](const Goal& goal) { return goal.quantity == *quantity; };
      if (!quantity)
        table.refuse("goal", fmt::format("names '{}'; it may be lift, drag, moment or pressure", word));
      if (std::ranges::any_of(goals, is_same)) table.refuse("goal", fmt::format("names '{}' twice", word));
      goals.push_back({*quantity});
    }
  }
  if (goals.empty())
    table.refuse("goal", "is empty; name what the flow is solved for, as in goal = \"drag\"");
  return goals;
}

void refuse_what_has_no_adjoint(const CaseTable& table, bool built_in, const EulerOptions& options) {
  if (!built_in)
    table.refuse(
        "goal",
        "needs the adjoint of the built-in solver, kind = \"euler\"; a solver of your own may write an "
        "error field of its own: adapt.variable = { error = \"name\" }");
  if (options.viscosity > 0)
    table.refuse("goal", "needs a flow without viscosity; leave out viscosity and reynolds, or the goal");
  if (options.time != EulerOptions::Time::steady)
    table.refuse("goal", "needs a steady flow; set time = \"steady\" or leave the goal out");
  if (options.far_field == EulerOptions::FarField::vortex)
    table.refuse(
        "goal",
        "needs the free stream beyond the far field; set far_field = \"uniform\", or leave the goal out");
  if (options.mach == 0) table.refuse("goal", "is a coefficient, which needs a mach above 0");
}

}  // namespace

void read_goals(const CaseTable& table, bool built_in, EulerOptions& options) {
  if (!table.has("goal")) {
    for (const char* const key : {"goal_on", "goal_about", "goal_adjoint"}) {
      if (table.has(key)) table.refuse(key, "says something of a goal; it needs goal, as in goal = \"drag\"");
    }
    return;
  }
  options.goals = read_quantities(table);
  refuse_what_has_no_adjoint(table, built_in, options);
  const std::vector<std::string> on =
      table.has("goal_on") ? table.texts("goal_on") : std::vector<std::string>{};
  const auto about = table.numbers("goal_about", 2);
  const bool has_moment = std::ranges::any_of(
      options.goals, [](const Goal& goal) { return goal.quantity == Goal::Quantity::moment; });
  if (about && !has_moment) table.refuse("goal_about", "is the point of a moment; add \"moment\" to goal");
  for (Goal& goal : options.goals) {
    goal.boundaries = on;
    if (about) goal.about = {about->at(0), about->at(1)};
  }
  options.adjoint_fields = table.choice("goal_adjoint", {"none", "write"}) == "write";
}

std::vector<Goal> goals_on(const std::vector<Goal>& goals, const std::vector<std::string>& boundaries) {
  std::vector<Goal> result = goals;
  for (Goal& goal : result) {
    const std::vector<std::string> patterns = goal.boundaries;
    goal.boundaries.clear();
    for (const std::string& name : boundaries) {
      if (std::ranges::any_of(patterns, [&](const std::string& p) { return matches(p, name); }))
        goal.boundaries.push_back(name);
    }
    for (const std::string& pattern : patterns) {
      if (std::ranges::none_of(boundaries, [&](const std::string& name) { return matches(pattern, name); }))
        throw InputError(
            fmt::format("'solver.goal_on' names '{}', but no boundary of the geometry is so named", pattern));
    }
  }
  return result;
}

}  // namespace quadloop
