#pragma once

#include <array>
#include <cstdint>

#include "mesher/geometry/shifted_outline.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// A square of the grid with its quarters: finds for a segment the quarters that it crosses, for all four
/// at once.
class QuarteredSquare {
 public:
  /// The outline must outlive the object.
  QuarteredSquare(const ShiftedOutline& outline, const TreeGrid& grid, const Quadrant& square);

  Box box() const { return {{x_[0], y_[0]}, {x_[2], y_[2]}}; }
  Box box_of(Corner quarter) const {
    const int k = curve_index(quarter), column = k % 2, row = k / 2;
    return {{x_[column], y_[row]}, {x_[column + 1], y_[row + 1]}};
  }

  struct Passage {
    unsigned quarters = 0;  ///< quarters whose interior the segment meets: one bit each, in curve order
    /// Contribution of the segment to the change of winding number from the lower left corner of the square
    /// to that of each quarter.
    std::array<int, 4> winding{};
  };
  /// For a segment that meets the interior of the square.
  Passage passage_of(std::int32_t segment) const;

 private:
  const ShiftedOutline* outline_;
  std::array<double, 3> x_, y_;  ///< the lines: low, middle, high
};

}  // namespace quadloop
