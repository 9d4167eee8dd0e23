#include "adapt/transfer/curve_shares.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace quadloop {

namespace {

constexpr std::int64_t samples_per_rank = 512;

/// The bits of a number spread apart, a zero between each two.
std::uint64_t spread_bits(std::uint32_t number) {
  std::uint64_t bits = number;
  bits = (bits | (bits << 16)) & 0x0000ffff0000ffffU;
  bits = (bits | (bits << 8)) & 0x00ff00ff00ff00ffU;
  bits = (bits | (bits << 4)) & 0x0f0f0f0f0f0f0f0fU;
  bits = (bits | (bits << 2)) & 0x3333333333333333U;
  return (bits | (bits << 1)) & 0x5555555555555555U;
}

std::uint64_t key_at(std::uint32_t x, std::uint32_t y) { return spread_bits(x) | (spread_bits(y) << 1); }

/// Rounded down, and so in the order of the coordinates.
std::uint32_t step_at(double offset, double scale) {
  const double step = offset * scale;
  if (!(step > 0)) return 0;
  return step >= 0x1p32 ? std::numeric_limits<std::uint32_t>::max() : static_cast<std::uint32_t>(step);
}

}  // namespace

CurveShares::CurveShares(const Communicator& comm, std::span<const Point> in_box, std::span<const Point> more) {
  set_box(comm, in_box);
  set_splits(comm, in_box, more);
}

void CurveShares::set_box(const Communicator& comm, std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.include(p);
  box = {{comm.minimum(box.low.x), comm.minimum(box.low.y)}, {comm.maximum(box.high.x), comm.maximum(box.high.y)}};
  const double side = std::max(box.width(), box.height());
  low_ = box.low;
  scale_ = side > 0 ? std::min(0x1p32 / side, std::numeric_limits<double>::max()) : 0;
}

/// Cuts at the quantiles of a sample: every so many-th point of all ranks.
void CurveShares::set_splits(const Communicator& comm, std::span<const Point> points, std::span<const Point> more) {
  const auto own = static_cast<std::int64_t>(points.size() + more.size());
  const std::int64_t before = comm.exclusive_sum(own), step = std::max<std::int64_t>(1, comm.sum(own) / (samples_per_rank * comm.size()));
  std::vector<std::uint64_t> keys;
  for (std::int64_t i = (step - before % step) % step; i < own; i += step) {
    const auto at = static_cast<std::size_t>(i);
    keys.push_back(key_of(at < points.size() ? points[at] : more[at - points.size()]));
  }
  keys = comm.all_gather_values(std::span<const std::uint64_t>(keys));
  std::sort(keys.begin(), keys.end());
  const auto ranks = static_cast<std::size_t>(comm.size());
  for (std::size_t rank = 1; rank < ranks; ++rank) splits_.push_back(keys.empty() ? 0 : keys[keys.size() * rank / ranks]);
}

CurveShares::Corner CurveShares::corner_of(Point p) const { return {step_at(p.x - low_.x, scale_), step_at(p.y - low_.y, scale_)}; }

std::uint64_t CurveShares::key_of(Point p) const {
  const Corner corner = corner_of(p);
  return key_at(corner.x, corner.y);
}

int CurveShares::rank_of_key(std::uint64_t key) const {
  return static_cast<int>(std::upper_bound(splits_.begin(), splits_.end(), key) - splits_.begin());
}

void CurveShares::ranks_meeting(const Box& box, std::vector<int>& ranks) const {
  ranks.clear();
  const Corner low = corner_of(box.low), high = corner_of(box.high);
  const int first = rank_of_key(key_at(low.x, low.y));
  if (first == rank_of_key(key_at(high.x, high.y))) {  // the curve passes the rest of a box between its two corners
    ranks.push_back(first);
    return;
  }
  const int bits = static_cast<int>(std::bit_width((low.x ^ high.x) | (low.y ^ high.y)));
  const auto start = [bits](std::uint32_t step) { return bits == 32 ? 0U : step >> bits << bits; };
  descend({low, high}, {start(low.x), start(low.y)}, bits, ranks);
}

/// The square of 2^bits steps a side, and so one stretch of the curve, as far as the box reaches into it.
void CurveShares::descend(const Corners& box, Corner cell, int bits, std::vector<int>& ranks) const {
  const auto last_step = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  const Corner end{cell.x + last_step, cell.y + last_step};
  if (end.x < box.low.x || end.y < box.low.y || cell.x > box.high.x || cell.y > box.high.y) return;
  const int first = rank_of_key(key_at(cell.x, cell.y));
  if (first == rank_of_key(key_at(end.x, end.y))) {
    if (ranks.empty() || ranks.back() != first) ranks.push_back(first);
    return;
  }
  const std::uint32_t half = 1U << (bits - 1);
  descend(box, cell, bits - 1, ranks);
  descend(box, {cell.x + half, cell.y}, bits - 1, ranks);
  descend(box, {cell.x, cell.y + half}, bits - 1, ranks);
  descend(box, {cell.x + half, cell.y + half}, bits - 1, ranks);
}

}  // namespace quadloop
