#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

#include "mesher/base/morton.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// The position of a unit square on the space-filling curve: the tree's number on the curve, then the Morton
/// key within the tree.
struct CurveKey {
  std::int32_t tree = 0;
  std::uint64_t square = 0;
  friend auto operator<=>(const CurveKey&, const CurveKey&) = default;
};

/// The partition of the space-filling curve, and so of the root, among the ranks.
class CurveOwners {
 public:
  /// `begins`: beginning of each rank's part, then the end of the curve. `tree_numbers`: for each tree, row
  /// by row, its number on the curve.
  CurveOwners(std::vector<CurveKey> begins, std::vector<std::int32_t> tree_numbers, int trees_x)
      : begins_{std::move(begins)}, tree_numbers_{std::move(tree_numbers)}, trees_x_{trees_x} {}

  std::size_t ranks() const { return begins_.size() - 1; }
  /// The key of the unit square with lower left grid vertex (x, y), inside the root.
  CurveKey key_at(std::int64_t x, std::int64_t y) const {
    constexpr std::int64_t within = (std::int64_t{1} << Quadrant::unit_level) - 1;
    const std::int64_t tree = (y >> Quadrant::unit_level) * trees_x_ + (x >> Quadrant::unit_level);
    return {tree_numbers_[tree],
            morton_key(static_cast<std::uint32_t>(x & within), static_cast<std::uint32_t>(y & within))};
  }
  int rank_of(const CurveKey& key) const {
    return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), key) - begins_.begin()) - 1;
  }
  bool owns(std::size_t rank, const CurveKey& key) const {
    return begins_[rank] <= key && key < begins_[rank + 1];
  }

 private:
  std::vector<CurveKey> begins_;
  std::vector<std::int32_t> tree_numbers_;
  int trees_x_;
};

}  // namespace quadloop
