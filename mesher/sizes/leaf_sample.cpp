#include "mesher/sizes/leaf_sample.hpp"

#include <algorithm>

#include "mesher/base/morton.hpp"

namespace quadloop {

LeafSample::Key LeafSample::key_of(const Quadrant& q) {
  constexpr std::int64_t within = (std::int64_t{1} << Quadrant::unit_level) - 1;
  return {(q.y >> Quadrant::unit_level << 32) + (q.x >> Quadrant::unit_level),
          morton_key(static_cast<std::uint32_t>(q.x & within), static_cast<std::uint32_t>(q.y & within))};
}

LeafSample::LeafSample(std::vector<Row> rows) {
  std::ranges::sort(rows, {}, [](const Row& row) { return key_of(row.leaf); });
  Counts sum;
  sums_.push_back(sum);
  for (const Row& row : rows) {
    keys_.push_back(key_of(row.leaf));
    (row.is_cut ? sum.cut : sum.uncut) += row.leaves;
    sums_.push_back(sum);
  }
}

LeafSample::Counts LeafSample::in(const Quadrant& q) const {
  if (keys_.empty()) return {};
  const Key first = key_of(q);
  const Key last{first.tree, first.square + (std::uint64_t{1} << (2 * (Quadrant::unit_level - q.level))) - 1};
  const Counts& before = sums_[std::ranges::lower_bound(keys_, first) - keys_.begin()];
  const Counts& up_to = sums_[std::ranges::upper_bound(keys_, last) - keys_.begin()];
  return {up_to.cut - before.cut, up_to.uncut - before.uncut};
}

}  // namespace quadloop
