#include "adapt/transfer/locate/curve_partition.hpp"

#include <algorithm>

namespace quadloop::adapt {

namespace {

constexpr std::int64_t samples_per_rank = 512;

}  // namespace

CurvePartition::CurvePartition(const Communicator& comm, std::span<const Point> in_grid,
                               std::span<const Point> more)
    : grid_(comm, in_grid) {
  set_splits(comm, in_grid, more);
}

/// Splits at the quantiles of a regular sample of all ranks' points.
void CurvePartition::set_splits(const Communicator& comm, std::span<const Point> points,
                                std::span<const Point> more) {
  const std::int64_t own = points.size() + more.size();
  const std::int64_t before = comm.exclusive_sum(own),
                     step = std::max<std::int64_t>(1, comm.sum(own) / (samples_per_rank * comm.size()));
  std::vector<std::uint64_t> keys;
  for (std::int64_t i = (step - before % step) % step; i < own; i += step) {
    const std::size_t at = i;
    keys.push_back(grid_.key_of(at < points.size() ? points[at] : more[at - points.size()]));
  }
  keys = comm.all_gather_values(std::span<const std::uint64_t>(keys));
  std::sort(keys.begin(), keys.end());
  const std::size_t ranks = comm.size();
  for (std::size_t rank = 1; rank < ranks; ++rank)
    splits_.push_back(keys.empty() ? 0 : keys[keys.size() * rank / ranks]);
}

int CurvePartition::rank_of_key(std::uint64_t key) const {
  return static_cast<int>(std::upper_bound(splits_.begin(), splits_.end(), key) - splits_.begin());
}

void CurvePartition::ranks_meeting(const Box& box, std::vector<int>& ranks) const {
  ranks.clear();
  const CurveGrid::Steps steps = grid_.steps_of(box);
  const int first = rank_of_key(CurveGrid::key_at(steps.low));
  if (first == rank_of_key(CurveGrid::key_at(steps.high))) {
    ranks.push_back(first);
    return;
  }
  descend(steps, CurveGrid::square_around(steps), ranks);
}

void CurvePartition::descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square,
                             std::vector<int>& ranks) const {
  if (!square.meets(steps)) return;
  const int first = rank_of_key(CurveGrid::key_at(square.begin));
  if (first == rank_of_key(CurveGrid::key_at(square.last()))) {
    if (ranks.empty() || ranks.back() != first) ranks.push_back(first);
    return;
  }
  for (int k = 0; k < 4; ++k) descend(steps, square.child(k), ranks);
}

}  // namespace quadloop::adapt
