#pragma once

#include <optional>

#include "mesher/geometry/segment_tree.hpp"
#include "mesher/geometry/shifted_outline.hpp"

namespace quadloop {

/// Decides whether a point lies in the domain of a shifted geometry, by an exact count of the crossings of a
/// ray to its left; a point on the boundary is outside. O(log n + k) for a ray that meets k boxes of
/// segments; the index is built on first use.
class Interior {
 public:
  explicit Interior(const ShiftedOutline& outline) : outline_{&outline} {}

  bool contains(Point p) const;

 private:
  const ShiftedOutline* outline_;
  mutable std::optional<SegmentTree> segments_;
};

}  // namespace quadloop
