#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

struct Segment {
  Point from, to;
};

/// The stations from one to before another.
struct StationRange {
  std::int32_t begin = 0, end = 0;
};

/// Search tree of segments of fronts, by their first stations. Runs of consecutive stations are indexed, as
/// in SegmentTree.
class FrontTree {
 public:
  FrontTree() = default;
  /// `segment(place)`: the segment after a station, if it is one of those to be found.
  template <class SegmentAt>
  FrontTree(const WallLine& line, const SegmentAt& segment) : boxes_(line.size()) {
    std::vector<Box> of_runs;
    for (std::int32_t begin = 0; begin < line.size();) {
      std::int32_t end = begin;
      Box of_run;
      do {
        if (const std::optional<Segment> s = segment(end)) {
          boxes_[end] = box_of(s->from, s->to);
          of_run.include(s->from);
          of_run.include(s->to);
        }
        ++end;
      } while (end < begin + longest_run && end < line.size() && line.next(end - 1) == end);
      if (of_run.width() >= 0) {
        runs_.push_back({begin, end});
        of_runs.push_back(of_run);
      }
      begin = end;
    }
    tree_ = BoxTree(of_runs);
  }
  /// Calls `found(place)` for segments whose boxes meet a box until it returns true; returns whether it did.
  template <class Found>
  bool any_meeting(const Box& box, const Found& found) const {
    return tree_.any_meeting(box, [&](std::int32_t run) {
      for (std::int32_t place = runs_[run].begin; place < runs_[run].end; ++place) {
        if (boxes_[place].meets(box) && found(place)) return true;
      }
      return false;
    });
  }
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    any_meeting(box, [&](std::int32_t place) {
      visit(place);
      return false;
    });
  }

 private:
  static constexpr std::int32_t longest_run = 8;
  std::vector<Box> boxes_;  ///< of each station; empty where there is no segment
  std::vector<StationRange> runs_;
  BoxTree tree_;
};

}  // namespace quadloop
