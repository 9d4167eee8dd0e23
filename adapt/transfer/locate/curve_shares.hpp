#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/curve_grid.hpp"

namespace quadloop {

/// The plane in one piece for each rank: stretches of a Morton curve with about equally many of the points
/// given. Who has what depends on the number of ranks; nothing of a result may.
class CurveShares {
 public:
  /// `points` are this rank's; the first list gives the grid. *Collective.*
  CurveShares(const Communicator& comm, std::span<const Point> in_grid, std::span<const Point> more);

  const CurveGrid& grid() const { return grid_; }

  /// The rank whose piece holds a point.
  int rank_of(Point p) const { return rank_of_key(grid_.key_of(p)); }

  /// The ranks whose pieces meet a box, ascending, in a list that is used again.
  void ranks_meeting(const Box& box, std::vector<int>& ranks) const;

 private:
  int rank_of_key(std::uint64_t key) const;
  void set_splits(const Communicator& comm, std::span<const Point> points, std::span<const Point> more);
  void descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square, std::vector<int>& ranks) const;

  CurveGrid grid_;
  std::vector<std::uint64_t> splits_;  ///< the first key of each rank but the first
};

}  // namespace quadloop
