#include "adapt/transfer/locate/point_cells.hpp"

#include <algorithm>

namespace quadloop::adapt {

namespace {

constexpr std::int64_t most_cells = 1 << 16, few_points = 8;
constexpr std::int64_t sparse_points =
    most_cells / 16;  // up to here each point gets a coarse square at least
constexpr CurveGrid::Square whole_grid{{}, 32};
constexpr int coarse_bits = 11, above_coarse = 32 - coarse_bits;  // 2048 by 2048 coarse squares
constexpr int word_bits = 64;
constexpr std::uint32_t most_coarse = 32;  ///< number of coarse squares per row that are tested one by one

/// Extracts every second bit of a key, beginning with the first: the inverse of spread_bits().
std::uint64_t every_other_bit(std::uint64_t key) {
  std::uint64_t bits = key & 0x5555555555555555ULL;
  bits = (bits | bits >> 1) & 0x3333333333333333ULL;
  bits = (bits | bits >> 2) & 0x0f0f0f0f0f0f0f0fULL;
  bits = (bits | bits >> 4) & 0x00ff00ff00ff00ffULL;
  bits = (bits | bits >> 8) & 0x0000ffff0000ffffULL;
  return (bits | bits >> 16) & 0x00000000ffffffffULL;
}

}  // namespace

PointCells::PointCells(const Communicator& comm, const CurveGrid& grid, std::span<const Point> points)
    : grid_{&grid} {
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Point p : points) keys.push_back(grid.key_of(p));
  std::sort(keys.begin(), keys.end());
  const std::int64_t all = comm.sum(std::ssize(keys)), few = std::max(few_points, 4 * all / most_cells);
  std::vector<Stretch> own;
  split(keys, whole_grid,
        {static_cast<std::size_t>(few), all <= sparse_points ? above_coarse : whole_grid.bits}, own);
  own = comm.all_gather_values(std::span<const Stretch>(own));
  std::sort(own.begin(), own.end(), [](const Stretch& a, const Stretch& b) {
    return a.first != b.first ? a.first < b.first : a.last > b.last;
  });
  for (const Stretch& stretch : own) {  // squares are nested or disjoint
    if (stretches_.empty() || stretches_.back().last < stretch.first) stretches_.push_back(stretch);
  }
  mark_occupied();
}

void PointCells::mark_occupied() {
  occupied_.assign((std::size_t{1} << 2 * coarse_bits) / word_bits, 0);
  for (const Stretch& stretch : stretches_) {
    const std::uint64_t last = stretch.last >> 2 * above_coarse;
    for (std::uint64_t square = stretch.first >> 2 * above_coarse; square <= last; ++square) {
      const std::uint64_t at = every_other_bit(square >> 1) << coarse_bits | every_other_bit(square);
      occupied_[at / word_bits] |= std::uint64_t{1} << at % word_bits;
    }
  }
}

/// Whether any coarse square that these steps meet is occupied.
bool PointCells::is_occupied(const CurveGrid::Steps& coarse) const {
  const std::uint64_t left = coarse.low.x, right = coarse.high.x;
  const std::uint64_t bits = (std::uint64_t{2} << (right - left)) - 1;
  for (std::uint64_t row = coarse.low.y; row <= coarse.high.y; ++row) {
    const std::uint64_t at = row << coarse_bits | left, word = at / word_bits, shift = at % word_bits;
    std::uint64_t found = occupied_[word] >> shift;
    if (right / word_bits != left / word_bits) found |= occupied_[word + 1] << (word_bits - shift);
    if ((found & bits) != 0) return true;
  }
  return false;
}

/// `keys`: those in the square, ascending.
void PointCells::split(std::span<const std::uint64_t> keys, const CurveGrid::Square& square, Limits most,
                       std::vector<Stretch>& stretches) {
  if (keys.empty()) return;
  if ((keys.size() <= most.points && square.bits <= most.bits) || square.bits == 0) {
    stretches.push_back({CurveGrid::key_at(square.begin), CurveGrid::key_at(square.last())});
    return;
  }
  for (int k = 0; k < 4; ++k) {
    const CurveGrid::Square child = square.child(k);
    const auto end = std::upper_bound(keys.begin(), keys.end(), CurveGrid::key_at(child.last()));
    const std::size_t count = end - keys.begin();
    split(keys.first(count), child, most, stretches);
    keys = keys.subspan(count);
  }
}

/// The first range that does not end before the key.
const PointCells::Stretch* PointCells::next(std::uint64_t key) const {
  const auto found = std::partition_point(stretches_.begin(), stretches_.end(),
                                          [key](const Stretch& stretch) { return stretch.last < key; });
  return found == stretches_.end() ? nullptr : &*found;
}

bool PointCells::meet(const Box& box) const {
  const CurveGrid::Steps steps = grid_->steps_of(box);
  const CurveGrid::Steps coarse{{steps.low.x >> above_coarse, steps.low.y >> above_coarse},
                                {steps.high.x >> above_coarse, steps.high.y >> above_coarse}};
  const std::uint32_t across = std::max(coarse.high.x - coarse.low.x, coarse.high.y - coarse.low.y);
  if (across < most_coarse) {  // a few squares of about the box's size cover it
    const bool is_met = is_occupied(coarse);
    if (!is_met || across > 0) return is_met;
  }
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

}  // namespace quadloop::adapt
