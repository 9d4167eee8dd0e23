#pragma once

#include <cstdint>
#include <vector>

#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Which quadrants must be split: those of the wanted tree, and those that are too large beside one of its
/// leaves. A leaf of size h at Chebyshev gap d from a leaf of the wanted tree of size h' has
/// h <= h' + (g-1)/2 d. The result is the smallest such tree. It follows that two leaves of the final tree
/// which touch differ by at most one level.
class Gradation {
 public:
  /// `tree` must outlive it.
  explicit Gradation(SizeTree& tree) : tree_{tree} {}

  /// Constant time on average where the quadrants come in the order of the curve, as it remembers the path to
  /// the last one. Not for a root.
  bool must_split(const Quadrant& q);
  /// The split nodes of the wanted tree, of the quadrant's size, that may force it to split; valid until the
  /// next call.
  const std::vector<std::int32_t>& split_near(const Quadrant& q);

 private:
  /// One step of the path from the root to the quadrant last asked for.
  struct Step {
    Quadrant quadrant;
    std::vector<std::int32_t> near;  ///< split nodes of half this size that may force a child of it to split
    bool has_near = false;
  };

  Step& step_above(const Quadrant& q);
  void fill_near(Step& step, const std::vector<std::int32_t>& parents);
  bool forced(const Quadrant& q, const std::vector<std::int32_t>& near);
  bool forced_by(const Quadrant& q, std::int32_t node);

  SizeTree& tree_;
  std::vector<Step> path_;
};

}  // namespace quadloop
