#pragma once

#include <cstdint>
#include <vector>

#include "mesher/sizes/gradation.hpp"

namespace quadloop {

/// Predicts the number of leaves below a quadrant from nearby nodes of the wanted tree.
class LeavesAhead {
 public:
  /// Both must outlive the object; `gradation` is that of the tree.
  LeavesAhead(SizeTree& tree, Gradation& gradation) : tree_{tree}, gradation_{gradation} {}

  /// Returns the approximate final number of leaves, at least 1, in a quadrant that must be split: accurate
  /// enough to find where most leaves will be.
  double below(const Quadrant& q);

 private:
  double source_leaves(const Quadrant& q) const;
  int level_ahead(std::int32_t node);

  SizeTree& tree_;
  Gradation& gradation_;
  std::vector<std::int8_t> levels_;  ///< of nodes, as far as computed; 0: not computed
};

}  // namespace quadloop
