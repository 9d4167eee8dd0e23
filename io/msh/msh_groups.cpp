#include "io/msh/msh_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "io/model/repeated_rows.hpp"

namespace quadloop::io {

void MshGroups::name_physical(int dimension, std::int64_t physical, std::string name) {
  names_[{dimension, std::abs(physical)}] = std::move(name);
}

void MshGroups::put_in_physical(int dimension, std::int64_t entity, std::int64_t physical) {
  std::vector<std::int64_t>& groups = entity_groups_[{dimension, entity}];
  if (std::ranges::count(groups, std::abs(physical)) > 0) return;
  groups.push_back(std::abs(physical));
  ++members_[{dimension, std::abs(physical)}];
}

std::int64_t MshGroups::members_of(int dimension, std::int64_t physical) const {
  const auto found = members_.find({dimension, physical});
  return found == members_.end() ? 0 : found->second;
}

std::int64_t MshGroups::physical_of(int dimension, std::int64_t entity) const {
  const auto found = entity_groups_.find({dimension, entity});
  if (found == entity_groups_.end()) return 0;
  return *std::ranges::min_element(found->second, {},
                                   [&](std::int64_t physical) { return members_of(dimension, physical); });
}

std::vector<std::string> MshGroups::overlaps(int lowest) const {
  constexpr std::array kinds{"point", "curve", "surface", "volume"};
  std::vector<std::string> lines;
  for (int dimension = lowest; dimension <= 3; ++dimension) {
    std::int64_t count = 0;
    std::string first;
    for (const auto& [key, groups] : entity_groups_) {
      if (key.first != dimension || groups.size() < 2 || ++count > 1) continue;
      std::vector<std::string> names;
      for (const std::int64_t physical : groups) names.push_back(name_of(dimension, physical));
      first = fmt::format("{} {} is in the physical groups {} and is assigned to '{}', the smallest",
                          kinds[dimension], key.second, some_names(names),
                          name_of(dimension, physical_of(dimension, key.second)));
    }
    if (count > 1) first += fmt::format("; likewise {} more {}s", count - 1, kinds[dimension]);
    if (count > 0) lines.push_back(first);
  }
  return lines;
}

std::vector<std::string> MshGroups::dropped(int lowest) const {
  std::vector<std::string> names;
  for (const auto& [key, name] : names_) {
    const bool is_kept = lowest == 1 && members_of(0, key.second) > 0;  // as named nodes
    if (key.first < lowest && !name.empty() && !is_kept) names.push_back(name);
  }
  if (names.empty()) return {};
  return {"physical groups of " + std::string(lowest == 1 ? "points" : "points and curves") +
          " are left out: " + some_names(names)};
}

std::string MshGroups::name_of(int dimension, std::int64_t physical) const {
  const auto found = names_.find({dimension, physical});
  return found == names_.end() || found->second.empty() ? "physical_" + std::to_string(physical)
                                                        : found->second;
}

}  // namespace quadloop::io
