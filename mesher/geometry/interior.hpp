#pragma once

#include "mesher/geometry/segment_tree.hpp"
#include "mesher/geometry/shifted_outline.hpp"

namespace quadloop {

/// Whether a point lies in the domain of a shifted outline, by an exact count of the crossings of a ray to
/// its left; a point on the outline itself is outside. O(log n + k) for a ray that meets k boxes of segments.
class Interior {
 public:
  explicit Interior(const ShiftedOutline& outline) : outline_{&outline}, segments_{outline.geometry()} {}

  bool contains(Point p) const;
  /// The block that contains a point of the domain.
  std::int32_t block_at(Point p) const;

 private:
  const ShiftedOutline* outline_;
  SegmentTree segments_;
};

}  // namespace quadloop
