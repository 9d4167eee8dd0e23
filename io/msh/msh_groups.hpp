#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quadloop {

/// The physical groups of an MSH file: their names, and the points, curves, surfaces and volumes in them.
class MshGroups {
 public:
  /// Of dimension 0 (points), 1 (curves), 2 (surfaces) or 3 (volumes); the tag's sign says nothing but a
  /// direction.
  void name_physical(int dimension, std::int64_t physical, std::string name);
  void put_in_physical(int dimension, std::int64_t entity, std::int64_t physical);

  /// The physical group of a point, curve, surface or volume; 0 where it is in none. Of several the one that
  /// has the fewest of them, the first where several are as small; so it is to be asked when all are put in.
  std::int64_t physical_of(int dimension, std::int64_t entity) const;

  /// How many entities a group has.
  std::int64_t members_of(int dimension, std::int64_t physical) const;

  /// For warnings, without the file's name: entities of that dimension or more in several groups, and named
  /// groups of fewer dimensions, which are left out.
  std::vector<std::string> overlaps(int lowest) const;
  std::vector<std::string> dropped(int lowest) const;

  /// The name of a physical group; "physical_<tag>" where the file gives none.
  std::string name_of(int dimension, std::int64_t physical) const;

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;

  std::map<Key, std::string> names_;                        ///< by dimension and tag
  std::map<Key, std::vector<std::int64_t>> entity_groups_;  ///< by dimension and tag
  std::map<Key, std::int64_t> members_;                     ///< of groups, by dimension and tag
};

}  // namespace quadloop
