#pragma once

#include <cstdint>
#include <vector>

#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// Sampled leaves of a forest that has not been created, each with a weight: gives the approximate number of
/// leaves below a quadrant. The leaves below a quadrant are contiguous on the curve, so that two entries of
/// cumulative sums are sufficient.
class LeafSample {
 public:
  struct Row {
    Quadrant leaf;
    double leaves = 1;  ///< number of leaves that it represents
  };
  LeafSample() = default;
  explicit LeafSample(std::vector<Row> rows);

  /// Returns the number of leaves in a quadrant; 0 if the sample has none.
  double leaves_in(const Quadrant& q) const;
  double leaves() const { return sums_.empty() ? 0 : sums_.back(); }

 private:
  /// Start of a square on the curve, the trees taken row by row.
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
