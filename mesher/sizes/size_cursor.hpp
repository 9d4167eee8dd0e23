#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Looks quadrants up in the wanted tree; few steps each where they come in the order of the curve, as it
/// remembers the way down to the last one.
class SizeCursor {
 public:
  /// `tree` must outlive it.
  explicit SizeCursor(SizeTree& tree) : tree_{tree} {}

  /// The segments that meet the inside of the quadrant, in ascending order; valid until the next call.
  std::span<const std::int32_t> segments_in(const Quadrant& q);
  /// Whether a corner of the quadrant lies in the domain.
  bool is_inside(const Quadrant& q, Corner corner);
  /// The level at which case, geometry and demands alone would have stopped at this leaf's place.
  int wanted_level(const Quadrant& leaf);

 private:
  template <class Enter>
  std::int32_t deepest_node_at(const Quadrant& q, const Enter& enter);
  std::int32_t deepest_with_geometry(const Quadrant& q);

  SizeTree& tree_;
  std::int64_t x_ = -1, y_ = -1;  ///< the corner of the quadrant last looked up, or one outside the root
  int depth_ = 0;                 ///< level of the node that was found for it
  std::array<std::int32_t, Quadrant::unit_level + 1> path_{};  ///< from the root down to that
  std::vector<std::int32_t> found_;
};

}  // namespace quadloop
