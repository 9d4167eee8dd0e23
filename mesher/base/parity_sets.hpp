#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace quadloop {

/// Disjoint sets of items, each with its direction relative to the set's root: a parity on every link. Cells
/// that hang together, some of which have to be turned where the others are not.
class ParitySets {
 public:
  explicit ParitySets(std::size_t items)
      : parents_(items), sizes_(items, 1), opposed_(items, 0), torn_(items, 0) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }

  struct Member {
    std::size_t root;
    bool opposed;  ///< whether the item has to be turned where the root is not
  };

  Member member_of(std::size_t item) {
    bool opposed = false;
    while (parents_[item] != item) {
      const std::size_t parent = parents_[item];
      opposed_[item] ^= opposed_[parent];  // a root is never opposed to itself
      parents_[item] = parents_[parent];
      opposed ^= opposed_[item] != 0;
      item = parents_[item];
    }
    return {item, opposed};
  }

  /// Says that exactly one of two items has to be turned (`opposed`), or both or none. Where that contradicts
  /// what was said before, the set is torn.
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
  std::vector<char> opposed_;  ///< to the parent
  std::vector<char> torn_;     ///< of a root
};

}  // namespace quadloop
