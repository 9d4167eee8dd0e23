#include "adapt/transfer/locate/point_cells.hpp"

#include <algorithm>

#include "mesher/base/morton.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t most_cells = 1 << 16, few_points = 8;
constexpr CurveGrid::Square whole_grid{{}, 32};
constexpr int coarse_bits = 11, above_coarse = 32 - coarse_bits;  // 2048 by 2048 coarse squares
constexpr int word_bits = 64;

}  // namespace

PointCells::PointCells(const Communicator& comm, const CurveGrid& grid, std::span<const Point> points)
    : grid_{&grid} {
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Point p : points) keys.push_back(grid.key_of(p));
  std::sort(keys.begin(), keys.end());
  const std::int64_t few = std::max(few_points, 4 * comm.sum(std::ssize(keys)) / most_cells);
  std::vector<Stretch> own;
  split(keys, whole_grid, few, own);
  own = comm.all_gather_values(std::span<const Stretch>(own));
  std::sort(own.begin(), own.end(), [](const Stretch& a, const Stretch& b) {
    return a.first != b.first ? a.first < b.first : a.last > b.last;
  });
  for (const Stretch& stretch : own) {  // squares lie in each other or apart
    if (stretches_.empty() || stretches_.back().last < stretch.first) stretches_.push_back(stretch);
  }
  mark_occupied();
}

void PointCells::mark_occupied() {
  occupied_.assign((std::size_t{1} << 2 * coarse_bits) / word_bits, 0);
  for (const Stretch& stretch : stretches_) {
    const std::uint64_t last = stretch.last >> 2 * above_coarse;
    for (std::uint64_t square = stretch.first >> 2 * above_coarse; square <= last; ++square)
      occupied_[square / word_bits] |= std::uint64_t{1} << square % word_bits;
  }
}

/// False only where no coarse square that these steps meet is occupied; of many nothing is said.
bool PointCells::may_be_occupied(const CurveGrid::Steps& steps) const {
  constexpr std::uint32_t few = 2;
  const std::uint32_t left = steps.low.x >> above_coarse, right = steps.high.x >> above_coarse,
                      low = steps.low.y >> above_coarse, high = steps.high.y >> above_coarse;
  if (right - left > few || high - low > few) return true;
  for (std::uint32_t y = low; y <= high; ++y) {
    for (std::uint32_t x = left; x <= right; ++x) {
      const std::uint64_t square = morton_key(x, y);
      if ((occupied_[square / word_bits] >> square % word_bits & 1) != 0) return true;
    }
  }
  return false;
}

/// `keys` are those in the square, ascending.
void PointCells::split(std::span<const std::uint64_t> keys, const CurveGrid::Square& square, std::size_t few,
                       std::vector<Stretch>& stretches) {
  if (keys.empty()) return;
  if (keys.size() <= few || square.bits == 0) {
    stretches.push_back({CurveGrid::key_at(square.begin), CurveGrid::key_at(square.last())});
    return;
  }
  for (int k = 0; k < 4; ++k) {
    const CurveGrid::Square child = square.child(k);
    const auto end = std::upper_bound(keys.begin(), keys.end(), CurveGrid::key_at(child.last()));
    const std::size_t count = end - keys.begin();
    split(keys.first(count), child, few, stretches);
    keys = keys.subspan(count);
  }
}

/// The first that does not end before the key.
const PointCells::Stretch* PointCells::next(std::uint64_t key) const {
  const auto found = std::partition_point(stretches_.begin(), stretches_.end(),
                                          [key](const Stretch& stretch) { return stretch.last < key; });
  return found == stretches_.end() ? nullptr : &*found;
}

bool PointCells::meet(const Box& box) const {
  const CurveGrid::Steps steps = grid_->steps_of(box);
  if (!may_be_occupied(steps)) return false;
  const std::uint64_t low = CurveGrid::key_at(steps.low), high = CurveGrid::key_at(steps.high);
  const Stretch* stretch = next(low);
  if (stretch == nullptr || stretch->first > high) return false;
  if (low == high) return true;
  return descend(steps, CurveGrid::square_around(steps));
}

bool PointCells::descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square) const {
  if (!square.meets(steps)) return false;
  const std::uint64_t first = CurveGrid::key_at(square.begin), last = CurveGrid::key_at(square.last());
  const Stretch* stretch = next(first);
  if (stretch == nullptr || stretch->first > last) return false;
  if (square.lies_in(steps) || (stretch->first <= first && last <= stretch->last)) return true;
  for (int k = 0; k < 4; ++k) {
    if (descend(steps, square.child(k))) return true;
  }
  return false;
}

}  // namespace quadloop
