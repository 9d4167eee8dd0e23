#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Settings for the boundaries whose name matches `pattern`; unset members change nothing.
struct BoundaryRule {
  std::string pattern;  ///< a name, optionally with * (any text) and ? (any character)
  std::optional<double> spacing, corner_degrees;
  std::optional<BoundaryCondition> condition;
  std::string where;       ///< where the rule stands, for messages
  bool must_match = true;  ///< a rule of ours (not the user's) may find nothing
  /// The boundary is added by us, perhaps later: patterns, meant for the user's own, do not reach it.
  bool claims = false;
  std::optional<double> corner_spacing = {};
  std::optional<LayerSpec> layers = {};
  std::optional<std::string> layers_in = {};
};

/// Whether the whole name matches the pattern.
bool matches(std::string_view pattern, std::string_view name);

/// Applies the rules in order, exact names after patterns, so that exact names override. Patterns do not
/// match claimed boundaries. Throws InputError for a rule without a match, neither in `names` nor among the
/// claimed boundaries, which may be added later.
std::vector<Boundary> boundaries_by_rules(const std::vector<std::string>& names,
                                          const std::vector<BoundaryRule>& rules,
                                          double default_corner_degrees);

}  // namespace quadloop
