#pragma once

#include <cstdint>
#include <vector>

#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// Leaves of a forest that is yet to be made, each of which stands for so many: from it follows about how
/// many leaves a quadrant will have. Those below a quadrant are one stretch of the curve, so that two places
/// in sums along it tell of all.
class LeafSample {
 public:
  struct Row {
    Quadrant leaf;
    double leaves = 1;  ///< for which it stands
  };
  LeafSample() = default;
  explicit LeafSample(std::vector<Row> rows);

  /// Below a quadrant or at it; 0 where the sample has none.
  double leaves_in(const Quadrant& q) const;
  double leaves() const { return sums_.empty() ? 0 : sums_.back(); }

 private:
  /// Where a square begins along the curve, the trees taken row by row.
  struct Key {
    std::int64_t tree;
    std::uint64_t square;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  static Key key_of(const Quadrant& q);

  std::vector<Key> keys_;
  std::vector<double> sums_;  ///< of the rows before each, and of all
};

}  // namespace quadloop
