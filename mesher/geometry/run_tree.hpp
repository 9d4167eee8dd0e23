#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/geometry/box_tree.hpp"

namespace quadloop {

/// Items of a numbered list: from one to before another.
struct ItemRun {
  std::int32_t begin = 0, end = 0;
};

/// Finds the items of a numbered list whose boxes meet a box. As neighbours in the list are close to each
/// other, runs of items are indexed (as in an arc tree, Günther 1988). O(log n + k) for k items in the runs
/// found.
template <class BoxOf>
class RunTree {
 public:
  RunTree() = default;
  /// `box_of(item)` is the box of an item; of one that is never to be found it is Box{}.
  RunTree(const std::vector<ItemRun>& runs, BoxOf box_of) : box_of_{std::move(box_of)} {
    std::vector<Box> boxes;
    for (const ItemRun& run : runs) {
      Box box;
      for (std::int32_t item = run.begin; item < run.end; ++item) box.include(box_of_(item));
      if (box.empty()) continue;
      runs_.push_back(run);
      boxes.push_back(box);
    }
    tree_ = BoxTree(boxes);
  }

  /// Calls `found(item)` for items whose boxes meet this closed box until it returns true; returns whether it
  /// did.
  template <class Found>
  bool any_meeting(const Box& box, const Found& found) const {
    return tree_.any_meeting(box, [&](std::int32_t run) {
      for (std::int32_t item = runs_[run].begin; item < runs_[run].end; ++item) {
        if (box_of_(item).meets(box) && found(item)) return true;
      }
      return false;
    });
  }

  /// Calls `visit(item)` for every item whose box meets this closed box.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    any_meeting(box, [&](std::int32_t item) {
      visit(item);
      return false;
    });
  }

 private:
  BoxOf box_of_;
  std::vector<ItemRun> runs_;
  BoxTree tree_;
};

}  // namespace quadloop
