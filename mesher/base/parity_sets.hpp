#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace quadloop {

/// Disjoint sets (union-find) with a parity on every link: the orientation of an item relative to the root of
/// its set. For connected cells, some of which must be reversed relative to others.
class ParitySets {
 public:
  explicit ParitySets(std::size_t items)
      : parents_(items), sizes_(items, 1), opposed_(items, 0), torn_(items, 0) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }

  struct Member {
    std::size_t root;
    bool opposed;  ///< whether the item must be reversed if the root is not, and vice versa
  };

  Member member_of(std::size_t item) {
    bool opposed = false;
    while (parents_[item] != item) {
      const std::size_t parent = parents_[item];
      opposed_[item] ^= opposed_[parent];  // the parity of a root is 0
      parents_[item] = parents_[parent];
      opposed ^= opposed_[item] != 0;
      item = parents_[item];
    }
    return {item, opposed};
  }

  /// Requires that exactly one of two items is reversed (`opposed`), or both or neither. A contradiction with
  /// earlier requirements marks the set as torn.
  void join(std::size_t first, std::size_t second, bool opposed) {
    Member a = member_of(first), b = member_of(second);
    const bool roots_opposed = (a.opposed != b.opposed) != opposed;
    if (a.root == b.root) {
      if (roots_opposed) torn_[a.root] = 1;
      return;
    }
    if (sizes_[a.root] < sizes_[b.root]) std::swap(a, b);
    parents_[b.root] = a.root;
    sizes_[a.root] += sizes_[b.root];
    opposed_[b.root] = roots_opposed ? 1 : 0;
    torn_[a.root] |= torn_[b.root];
  }

  bool is_torn(std::size_t root) const { return torn_[root] != 0; }

 private:
  std::vector<std::size_t> parents_, sizes_;
  std::vector<char> opposed_;  ///< relative to the parent
  std::vector<char> torn_;     ///< valid for roots
};

}  // namespace quadloop
