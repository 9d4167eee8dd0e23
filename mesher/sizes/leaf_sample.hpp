#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// Leaves of a forest that is yet to be made, each of which stands for so many: from it follows about how
/// many leaves there will be in a quadrant. The samples below a quadrant are one stretch of the curve, so
/// that two places in sums along it tell of all.
class LeafSample {
 public:
  struct Row {
    Quadrant leaf;
    double leaves = 1;    ///< for which it stands
    bool is_cut = false;  ///< whether they hold outline
  };
  LeafSample() = default;
  explicit LeafSample(std::vector<Row> rows);

  /// Of both kinds, below a quadrant or at it; 0 where the sample has none.
  struct Counts {
    double cut = 0, uncut = 0;
  };
  Counts in(const Quadrant& q) const;
  Counts all() const { return sums_.empty() ? Counts{} : sums_.back(); }

 private:
  /// Where a square begins along the curve, the trees taken row by row.
  struct Key {
    std::int64_t tree;
    std::uint64_t square;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  static Key key_of(const Quadrant& q);

  std::vector<Key> keys_;
  std::vector<Counts> sums_;  ///< of the rows before each, and of all
};

}  // namespace quadloop
