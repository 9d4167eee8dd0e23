#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/curve_grid.hpp"

namespace quadloop::adapt {

/// The distribution of points, as grid squares with a few points each; every rank has all ranks' squares, at
/// most about 65 000.
class PointCells {
 public:
  /// `points` are local. The grid must outlive the cells. *Collective.*
  PointCells(const Communicator& comm, const CurveGrid& grid, std::span<const Point> points);

  /// False only if the box, border included, contains none of the points.
  bool meet(const Box& box) const;

  /// Calls `visit(i)` for each `i` below `count` whose `box_of(i)` meets the squares. Neighbouring boxes
  /// should be consecutive: rows of boxes are tested together first.
  template <class BoxOf, class Visit>
  void for_each_met(std::size_t count, const BoxOf& box_of, const Visit& visit) const {
    std::array<Box, 32> row;
    for (std::size_t begin = 0; begin < count; begin += row.size()) {
      const std::size_t size = std::min(row.size(), count - begin);
      Box all;
      for (std::size_t k = 0; k < size; ++k) {
        row[k] = box_of(begin + k);
        all.low = {std::min(all.low.x, row[k].low.x), std::min(all.low.y, row[k].low.y)};
        all.high = {std::max(all.high.x, row[k].high.x), std::max(all.high.y, row[k].high.y)};
      }
      if (!meet(all)) continue;
      for (std::size_t k = 0; k < size; ++k) {
        if (meet(row[k])) visit(begin + k);
      }
    }
  }

 private:
  /// A range of the curve, its last step included.
  struct Stretch {
    std::uint64_t first = 0, last = 0;
  };
  /// Of a square: the number of its points, and its size.
  struct Limits {
    std::size_t points;
    int bits;
  };
  static void split(std::span<const std::uint64_t> keys, const CurveGrid::Square& square, Limits most,
                    std::vector<Stretch>& stretches);
  const Stretch* next(std::uint64_t key) const;
  bool descend(const CurveGrid::Steps& steps, const CurveGrid::Square& square) const;

  void mark_occupied();
  bool is_occupied(const CurveGrid::Steps& coarse) const;

  const CurveGrid* grid_;
  std::vector<Stretch> stretches_;  ///< consecutive, without overlaps
  /// A bit for each coarse square, row by row; most boxes meet few of these.
  std::vector<std::uint64_t> occupied_;
};

}  // namespace quadloop::adapt
