#pragma once

#include <array>
#include <cstdint>

#include "mesher/geometry/shifted_outline.hpp"
#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// A square of the lattice and its quarters: where segments pass, asked once for all four.
class QuarteredSquare {
 public:
  /// The outline must outlive it.
  QuarteredSquare(const ShiftedOutline& outline, const Lattice& lattice, const Quadrant& square);

  Box box() const { return {{x_[0], y_[0]}, {x_[2], y_[2]}}; }
  Box box_of(Corner quarter) const {
    const int k = curve_index(quarter), column = k % 2, row = k / 2;
    return {{x_[column], y_[row]}, {x_[column + 1], y_[row + 1]}};
  }

  struct Passage {
    unsigned quarters = 0;  ///< whose insides the segment meets: a bit for each, along the curve
    /// What crossing the segment adds to the winding number, from the lower left corner of the square to that
    /// of each quarter.
    std::array<int, 4> winding{};
  };
  /// Of a segment that meets the inside of the square.
  Passage passage_of(std::int32_t segment) const;

 private:
  const ShiftedOutline* outline_;
  std::array<double, 3> x_, y_;  ///< the lines: low, middle, high
};

}  // namespace quadloop
