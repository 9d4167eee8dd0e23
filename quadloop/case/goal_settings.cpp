#include "quadloop/case/goal_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"

namespace quadloop {

namespace {

/// Reads a word, a list of words, or a table of words with error weights.
GoalWeights read_quantities(const io::CaseTable& table, const std::string& key) {
  const std::vector<std::string> words = words_of(flow::Goal::words);
  GoalWeights goals;
  if (table.is_table(key)) {
    const io::CaseTable weights = *table.table(key);
    refuse_unknown_keys(weights, words);
    for (const auto& [word, quantity] : flow::Goal::words) {
      if (const auto weight = weights.number(word, io::Range::positive()))
        goals.emplace_back(quantity, *weight);
    }
  } else {
    for (const std::string& word : texts(words).read(table, key)) {
      const std::pair goal{*value_of(flow::Goal::words, word), 1.0};
      if (std::ranges::count(goals, goal) > 0) table.refuse(key, fmt::format("names '{}' twice", word));
      goals.push_back(goal);
    }
  }
  if (goals.empty()) table.refuse(key, "is empty; name what the flow is solved for, as in goal = \"drag\"");
  return goals;
}

}  // namespace

std::vector<Key<SolverSettings>> goal_keys() {
  return {
      key<&SolverSettings::goals>(
          "goal", ValueForm<GoalWeights>{"text, a list, or a table", "\"drag\"", read_quantities},
          "[Output functional](../explanation/adaptation.md#output-functionals-and-adjoints): `drag`, "
          "`lift`, `moment` or `pressure`; a list of them, or a table of weights.",
          {.fallback = "none",
           .needs =
               {{"kind = \"euler\"",
                 "it takes the adjoint of the built-in solver; a solver of your own may write an error field "
                 "of its own: adapt.variable = { error = \"name\" }"},
                {"viscosity = 0", "the adjoint is that of a flow without viscosity"},
                {"no reynolds", "the adjoint is that of a flow without viscosity; leave one of them out"},
                {"time = \"steady\"", "set it, or leave the goal out"},
                {"far_field = \"uniform\"", "set it, or leave the goal out"},
                {"mach > 0", "it is a coefficient"}}}),
      key<&SolverSettings::goal_on>("goal_on", texts(),
                                    "Boundaries of the functional, with patterns: `[\"flap\", \"slat_*\"]`.",
                                    {.fallback = "all walls", .needs = {{"goal"}}}),
      key<&SolverSettings::goal_about>("goal_about", point(), "Reference point of a moment.",
                                       {.fallback = "`[0, 0]`", .needs = {{"goal"}}}),
      key<&SolverSettings::euler, &flow::EulerOptions::adjoint_fields>(
          "goal_adjoint", choice<bool>({{"none", false}, {"write", true}}),
          "`write`: the adjoint solution and the derivatives of the functional with respect to node "
          "positions are added to the variables of the flow.",
          {.needs = {{"goal"}}})};
}

void place_goals(const io::CaseTable& table, SolverSettings& settings) {
  const Point about = settings.goal_about.value_or(Point{});
  for (const auto& [quantity, weight] : settings.goals)
    settings.euler.goals.push_back({quantity, settings.goal_on, about, weight});
  if (settings.goal_about &&
      std::ranges::count(settings.euler.goals, flow::Goal::Quantity::moment, &flow::Goal::quantity) == 0)
    table.refuse("goal_about", "is the point of a moment; add \"moment\" to goal");
}

std::vector<flow::Goal> goals_on(const std::vector<flow::Goal>& goals,
                                 const std::vector<std::string>& boundaries) {
  std::vector<flow::Goal> result = goals;
  for (flow::Goal& goal : result) {
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
