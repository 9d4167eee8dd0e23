#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Finds quadrants in the wanted tree; few steps each for quadrants in curve order, as the path to the last
/// one is stored.
class SizeCursor {
 public:
  /// `tree` must outlive the object.
  explicit SizeCursor(SizeTree& tree) : tree_{tree} {}

  /// Returns the segments that meet the interior of the quadrant, in ascending order; valid until the next
  /// call.
  std::span<const std::int32_t> segments_in(const Quadrant& q);
  /// Whether a corner of the quadrant lies in the domain.
  bool is_inside(const Quadrant& q, Corner corner);
  /// Returns the level of this leaf's place in the wanted tree, i.e. without gradation.
  int target_level(const Quadrant& leaf);

 private:
  template <class Enter>
  std::int32_t deepest_node_at(const Quadrant& q, const Enter& enter);
  std::int32_t deepest_with_geometry(const Quadrant& q);

  SizeTree& tree_;
  std::int64_t x_ = -1, y_ = -1;  ///< corner of the last quadrant, or a point outside the root
  int depth_ = 0;                 ///< level of the node found for it
  std::array<std::int32_t, Quadrant::unit_level + 1> path_{};  ///< from the root to that node
  std::vector<std::int32_t> found_;
};

}  // namespace quadloop
