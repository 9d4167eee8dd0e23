#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// The segments of an outline whose boxes meet a box. As an outline's neighbours lie beside each other
/// anyway, runs of them are indexed, not each (as in an arc tree, Günther 1988): 4 bytes a segment. O(log n +
/// k) for k segments in the runs found. The geometry must outlive it.
class SegmentTree {
 public:
  explicit SegmentTree(const Geometry& geometry);

  /// Asks `found(segment)` of those whose boxes meet this closed one, until it says true; whether it did.
  template <class Found>
  bool any_meeting(const Box& box, const Found& found) const {
    return runs_.any_meeting(box, [&](std::int32_t run) {
      for (std::int32_t s = starts_[run]; s < starts_[run + 1]; ++s) {
        if (box_of_segment(s).meets(box) && found(s)) return true;
      }
      return false;
    });
  }

  /// Calls `visit(segment)` for every one whose box meets this closed one.
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
  std::vector<std::int32_t> starts_;  ///< of the runs, each of one loop; and the end
  BoxTree runs_;
};

}  // namespace quadloop
