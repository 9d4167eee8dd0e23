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
  sums_.push_back(0);
  for (const Row& row : rows) {
    keys_.push_back(key_of(row.leaf));
    sums_.push_back(sums_.back() + row.leaves);
  }
}

double LeafSample::leaves_in(const Quadrant& q) const {
  if (keys_.empty()) return 0;
  const Key first = key_of(q);
  const std::uint64_t squares = std::uint64_t{1} << (2 * (Quadrant::unit_level - q.level));
  const auto begin = std::ranges::lower_bound(keys_, first);
  const auto end = std::ranges::lower_bound(begin, keys_.end(), Key{first.tree, first.square + squares});
  return sums_[end - keys_.begin()] - sums_[begin - keys_.begin()];
}

}  // namespace quadloop
