#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// What the user asks of the boundaries whose name matches `pattern`; what is not set is left as it is.
struct BoundaryRule {
  std::string pattern;  ///< a name, or one with * (any text) and ? (any character)
  std::optional<double> spacing, corner_degrees;
  std::optional<std::string> condition;
  std::string where;       ///< where the rule stands, for messages
  bool must_match = true;  ///< a rule of ours (not the user's) may find nothing
  bool claims = false;  ///< the boundary was added by us: patterns, meant for the user's own, do not reach it
  std::optional<double> corner_spacing = {};
  std::optional<LayerSpec> layers = {};
};

/// Whether the whole name matches the pattern.
bool matches(std::string_view pattern, std::string_view name);

/// The boundaries with the rules applied in their order, those with exact names after those with patterns, so
/// that exact names win; patterns leave those that are claimed. Throws InputError for a rule that matches
/// none.
std::vector<Boundary> boundaries_by_rules(const std::vector<std::string>& names,
                                          const std::vector<BoundaryRule>& rules,
                                          double default_corner_degrees);

}  // namespace quadloop
