#include "io/msh/msh_groups.hpp"

#include <algorithm>
#include <cstdlib>

namespace quadloop {

void MshGroups::name_physical(int dimension, std::int64_t physical, std::string name) {
  names_[{dimension, std::abs(physical)}] = std::move(name);
}

void MshGroups::put_in_physical(int dimension, std::int64_t entity, std::int64_t physical) {
  entity_groups_[{dimension, entity}] = std::abs(physical);
}

std::int64_t MshGroups::physical_of(int dimension, std::int64_t entity) const {
  const auto found = entity_groups_.find({dimension, entity});
  return found == entity_groups_.end() ? 0 : found->second;
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
