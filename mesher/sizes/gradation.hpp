#pragma once

#include <cstdint>
#include <vector>

#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Growth limit: determines the quadrants that must be split, which are those of the wanted tree and those
/// that are too large next to one of its leaves. A leaf of size h at Chebyshev distance d from a leaf of the
/// wanted tree of size h' satisfies h <= h' + (g-1)/2 d. The result is the smallest such tree. As a
/// consequence, adjacent leaves of the final tree differ by at most one level.
class Gradation {
 public:
  /// `tree` must outlive the object.
  explicit Gradation(SizeTree& tree) : tree_{tree} {}

  /// Whether the quadrant must be split. Constant time on average for quadrants in curve order, as the path
  /// to the last one is stored. Not for a root.
  bool must_split(const Quadrant& q);
  /// Returns the split nodes of the wanted tree, of the quadrant's size, that may force it to split; valid
  /// until the next call.
  const std::vector<std::int32_t>& split_near(const Quadrant& q);

 private:
  /// One step of the path from the root to the last quadrant.
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
