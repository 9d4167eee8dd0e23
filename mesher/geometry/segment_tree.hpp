#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Finds the segments of a geometry whose boxes meet a box. As neighbouring segments are close to each other,
/// runs of segments are indexed (as in an arc tree, Günther 1988): 4 bytes per segment. O(log n + k) for k
/// segments in the runs found. The geometry must outlive it.
class SegmentTree {
 public:
  explicit SegmentTree(const Geometry& geometry);

  /// Calls `found(segment)` for segments whose boxes meet this closed box until it returns true; returns
  /// whether it did.
  template <class Found>
  bool any_meeting(const Box& box, const Found& found) const {
    return runs_.any_meeting(box, [&](std::int32_t run) {
      for (std::int32_t s = starts_[run]; s < starts_[run + 1]; ++s) {
        if (box_of_segment(s).meets(box) && found(s)) return true;
      }
      return false;
    });
  }

  /// Calls `visit(segment)` for every segment whose box meets this closed box.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    any_meeting(box, [&](std::int32_t s) {
      visit(s);
      return false;
    });
  }

 private:
  Box box_of_segment(std::int32_t s) const {
    return box_of(geometry_->point(s), geometry_->point(geometry_->next(s)));
  }

  const Geometry* geometry_;
  std::vector<std::int32_t> starts_;  ///< of the runs, each within one loop; then the end
  BoxTree runs_;
};

}  // namespace quadloop
