#pragma once

#include <cstdint>
#include <vector>

#include "mesher/sizes/gradation.hpp"

namespace quadloop {

/// Guesses what splitting a quadrant leads to, from what the nodes of the wanted tree near it ask for.
class LeavesAhead {
 public:
  /// Both must outlive it; `gradation` is that of the tree.
  LeavesAhead(SizeTree& tree, Gradation& gradation) : tree_{tree}, gradation_{gradation} {}

  /// How many leaves a quadrant that must be split will hold in the end, about, at least 1: good enough to
  /// tell where most are to be looked for.
  double below(const Quadrant& q);

 private:
  double source_leaves(const Quadrant& q) const;
  int level_ahead(std::int32_t node);

  SizeTree& tree_;
  Gradation& gradation_;
  std::vector<std::int8_t> levels_;  ///< of nodes, as far as they were asked for; 0: not yet
};

}  // namespace quadloop
