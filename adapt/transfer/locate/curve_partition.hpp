#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/curve_grid.hpp"

namespace quadloop::adapt {

/// Partition of the plane among the ranks: ranges of a Morton curve with about equal numbers of the given
/// points. It depends on the number of ranks; results must not.
class CurvePartition {
 public:
  /// The points are local ones; the first list defines the grid. *Collective.*
  CurvePartition(const Communicator& comm, std::span<const Point> in_grid, std::span<const Point> more);

  const CurveGrid& grid() const { return grid_; }

  /// The rank whose part contains a point.
  int rank_of(Point p) const { return rank_of_key(grid_.key_of(p)); }

  /// The ranks whose parts meet a box, ascending; reuses the list.
  void ranks_meeting(const Box& box, std::vector<int>& ranks) const;

 private:
  int rank_of_key(std::uint64_t key) const;
  void set_splits(const Communicator& comm, std::span<const Point> points, std::span<const Point> more);
  void descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square, std::vector<int>& ranks) const;

  CurveGrid grid_;
  std::vector<std::uint64_t> splits_;  ///< first key of each rank except rank 0
};

}  // namespace quadloop::adapt
