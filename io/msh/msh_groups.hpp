#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quadloop::io {

/// The physical groups of an MSH file: their names, and their points, curves, surfaces and volumes.
class MshGroups {
 public:
  /// Dimension 0 is for points, 1 for curves, 2 for surfaces, 3 for volumes; the sign of the tag only gives a
  /// direction.
  void name_physical(int dimension, std::int64_t physical, std::string name);
  void put_in_physical(int dimension, std::int64_t entity, std::int64_t physical);

  /// Returns the physical group of a point, curve, surface or volume; 0 if it is in none. Of several groups
  /// the smallest, the first of equally small ones; so call it after all members have been added.
  std::int64_t physical_of(int dimension, std::int64_t entity) const;

  /// Returns the number of entities of a group.
  std::int64_t members_of(int dimension, std::int64_t physical) const;

  /// Return warnings, without the file's name: entities of at least that dimension in several groups, and
  /// named groups of lower dimension, which are omitted, unless they are nodes of a plane mesh.
  std::vector<std::string> overlaps(int lowest) const;
  std::vector<std::string> dropped(int lowest) const;

  /// Returns the name of a physical group; "physical_<tag>" if the file has none.
  std::string name_of(int dimension, std::int64_t physical) const;

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;

  std::map<Key, std::string> names_;                        ///< by dimension and tag
  std::map<Key, std::vector<std::int64_t>> entity_groups_;  ///< by dimension and tag
  std::map<Key, std::int64_t> members_;  ///< number of members of groups, by dimension and tag
};

}  // namespace quadloop::io
