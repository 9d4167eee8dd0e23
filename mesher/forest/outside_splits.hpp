#pragma once

#include <array>
#include <vector>

#include "mesher/forest/forest.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

/// Quadrants outside the domain, which no size is asked of: they are split only so far that leaves which
/// touch differ by one level at most. What is split in the domain is noted as it is split; what it asks of
/// the quadrants outside follows when all of it is known.
class OutsideSplits {
 public:
  /// `sizes` must outlive it.
  explicit OutsideSplits(const SizeTree& sizes) : sizes_{sizes}, cursor_{sizes}, lately_(window * window) {}

  /// Whether a quadrant that sizes ask to split is split for it: not where it lies outside. To be asked once
  /// of each; constant time on average in the order of the curve.
  bool is_split_by_size(const Quadrant& q);
  /// Once sizes split nothing more: splits what that asks for outside. *Collective.*
  void split(const Communicator& comm, Forest& forest);

 private:
  void add_parents_round(const Quadrant& q, std::vector<Quadrant>& above);

  bool is_new(const Quadrant& q);

  static constexpr std::int64_t window =
      32;  ///< so many quadrants in each direction have places of their own
  const SizeTree& sizes_;
  SizeCursor cursor_;
  std::vector<Quadrant> lately_;  ///< looked at, row by row of the window
  /// By level: split ones through which the outline goes, and whose corner in the middle of those that they
  /// ask for lies outside.
  std::array<std::vector<Quadrant>, Quadrant::unit_level + 1> cut_;
};

}  // namespace quadloop
