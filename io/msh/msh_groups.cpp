#include "io/msh/msh_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "io/loaded/repeated_rows.hpp"

namespace quadloop {

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

GroupSizes MshGroups::sizes() const {
  GroupSizes sizes;
  const auto put = [](std::vector<std::int64_t>& list, std::int32_t number, std::int64_t members) {
    if (number >= std::ssize(list)) list.resize(number + 1, 0);
    list[number] += members;
  };
  for (const auto& [key, boundary] : boundaries_)
    put(sizes.of_boundaries, boundary, members_of(1, key.first));
  for (const auto& [physical, block] : blocks_) put(sizes.of_blocks, block, members_of(2, physical));
  return sizes;
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
      first = fmt::format("{} {} is in the physical groups {} and is taken for '{}', the smallest",
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
    if (key.first < lowest && !name.empty()) names.push_back(name);
  }
  if (names.empty()) return {};
  return {"physical groups of " + std::string(lowest == 1 ? "points" : "points and curves") +
          " are left out: " + some_names(names)};
}

std::int32_t MshGroups::boundary_of(ForeignMesh& foreign, std::int64_t physical, std::int64_t entity) {
  const Key key{std::abs(physical), physical == 0 ? entity : 0};
  const auto found = boundaries_.find(key);
  if (found != boundaries_.end()) return found->second;
  const std::string name = physical == 0 ? "boundary_" + std::to_string(entity) : name_of(1, key.first);
  return boundaries_[key] = foreign.boundary_named(name);
}

std::int32_t MshGroups::block_of(ForeignMesh& foreign, std::int64_t physical) {
  const auto found = blocks_.find(std::abs(physical));
  if (found != blocks_.end()) return found->second;
  return blocks_[std::abs(physical)] =
             foreign.block_named(physical == 0 ? "domain" : name_of(2, std::abs(physical)));
}

std::int64_t MshGroups::curves_without_group() const {
  return std::count_if(boundaries_.begin(), boundaries_.end(),
                       [](const auto& entry) { return entry.first.first == 0; });
}

std::string MshGroups::name_of(int dimension, std::int64_t physical) const {
  const auto found = names_.find({dimension, physical});
  return found == names_.end() || found->second.empty() ? "physical_" + std::to_string(physical)
                                                        : found->second;
}

}  // namespace quadloop
