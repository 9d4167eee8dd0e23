#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/curve_grid.hpp"

namespace quadloop {

/// Where points lie, in squares of the grid that hold a few of them each; every rank has all ranks' squares,
/// at most some 65 000.
class PointCells {
 public:
  /// `points` are this rank's. The grid must outlive the cells. *Collective.*
  PointCells(const Communicator& comm, const CurveGrid& grid, std::span<const Point> points);

  /// False only where the box, its rim included, holds none of the points.
  bool meet(const Box& box) const;

 private:
  /// A stretch of the curve, its last step included.
  struct Stretch {
    std::uint64_t first = 0, last = 0;
  };
  static void split(std::span<const std::uint64_t> keys, const CurveGrid::Square& square, std::size_t few,
                    std::vector<Stretch>& stretches);
  const Stretch* next(std::uint64_t key) const;
  bool descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square) const;

  void mark_occupied();
  bool may_be_occupied(const CurveGrid::Steps& steps) const;

  const CurveGrid* grid_;
  std::vector<Stretch> stretches_;  ///< one after another, without overlaps
  /// A bit for each of the coarse squares, of which most boxes meet few, row by row.
  std::vector<std::uint64_t> occupied_;
};

}  // namespace quadloop
