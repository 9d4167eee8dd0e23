#include "mesher/geometry/assemble/boundary_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"

namespace quadloop {

namespace {

bool is_pattern(std::string_view text) { return text.find_first_of("*?") != std::string_view::npos; }

void apply_rule(const BoundaryRule& rule, Boundary& boundary) {
  boundary.spacing = rule.spacing.value_or(boundary.spacing);
  boundary.corner_degrees = rule.corner_degrees.value_or(boundary.corner_degrees);
  boundary.condition = rule.condition.value_or(boundary.condition);
  boundary.corner_spacing = rule.corner_spacing.value_or(boundary.corner_spacing);
  if (rule.layers) boundary.layers = rule.layers;
  boundary.layers_in = rule.layers_in.value_or(boundary.layers_in);
}

bool is_claimed(const std::vector<BoundaryRule>& rules, const std::string& name) {
  return std::any_of(rules.begin(), rules.end(),
                     [&name](const BoundaryRule& rule) { return rule.claims && rule.pattern == name; });
}

/// Returns the names, and those of boundaries that are added later.
std::vector<std::string> names_with_claimed(std::vector<std::string> names,
                                            const std::vector<BoundaryRule>& rules) {
  for (const BoundaryRule& rule : rules) {
    if (rule.claims && std::ranges::count(names, rule.pattern) == 0) names.push_back(rule.pattern);
  }
  return names;
}

}  // namespace

bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;  // the last * matches one more character
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<Boundary> boundaries_by_rules(const std::vector<std::string>& names,
                                          const std::vector<BoundaryRule>& rules,
                                          double default_corner_degrees) {
  std::vector<Boundary> boundaries;
  for (const std::string& name : names) boundaries.push_back({name, 0, default_corner_degrees});
  for (const bool patterns : {true, false}) {
    for (const BoundaryRule& rule : rules) {
      if (is_pattern(rule.pattern) != patterns) continue;
      bool found = is_claimed(rules, rule.pattern);
      for (Boundary& boundary : boundaries) {
        if (!matches(rule.pattern, boundary.name) || (patterns && is_claimed(rules, boundary.name))) continue;
        apply_rule(rule, boundary);
        found = true;
      }
      if (!found && rule.must_match) {
        const std::vector<std::string> known = names_with_claimed(names, rules);
        const std::string hint = rule.pattern == "farfield" ? "; geometry.far_field adds a far field"
                                                            : guess_for(rule.pattern, known);
        throw InputError(fmt::format("{}: no boundary of the geometry matches '{}'; it has: {}{}", rule.where,
                                     rule.pattern, first_few(known), hint));
      }
    }
  }
  return boundaries;
}

}  // namespace quadloop
