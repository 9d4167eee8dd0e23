#pragma once

#include <array>
#include <vector>

#include "mesher/forest/forest.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

/// Handles quadrants outside the domain, where no sizes are prescribed: they are split only as far as needed
/// for the 2:1 balance of touching leaves. Splits in the domain are recorded as they occur; the splits that
/// they require outside follow when all are known.
class OutsideSplits {
 public:
  /// `sizes` must outlive it.
  explicit OutsideSplits(SizeTree& sizes) : sizes_{sizes}, cursor_{sizes}, lately_(window * window) {}

  /// Whether a quadrant that the size field would split is split: not if it lies outside. Call once for each;
  /// constant time on average in the order of the curve.
  bool is_split_by_size(const Quadrant& q);
  /// Call when sizes split nothing more: performs the splits required outside. *Collective.*
  void split(const Communicator& comm, Forest& forest);

 private:
  void add_parents_round(const Quadrant& q, std::vector<Quadrant>& above);

  bool is_new(const Quadrant& q);

  static constexpr std::int64_t window =
      32;  ///< so many quadrants in each direction have places of their own
  SizeTree& sizes_;
  SizeCursor cursor_;
  std::vector<Quadrant> lately_;  ///< recently visited quadrants, row by row of the window
  /// For each level: split quadrants that the boundary intersects and whose required parents share a corner
  /// outside the domain.
  std::array<std::vector<Quadrant>, Quadrant::unit_level + 1> cut_;
};

}  // namespace quadloop
