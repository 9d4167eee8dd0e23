#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/geometry/run_tree.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

struct Segment {
  Point from, to;
};

/// A box for each station.
struct BoxesOfStations {
  std::vector<Box> boxes;

  const Box& operator()(std::int32_t station) const { return boxes[station]; }
};

/// Search tree of segments of fronts, by their first stations.
class FrontTree : public RunTree<BoxesOfStations> {
 public:
  FrontTree() = default;
  /// `segment(station)`: the segment after a station, if it is one of those to be found.
  template <class SegmentAt>
  FrontTree(const WallLine& line, const SegmentAt& segment)
      : RunTree{runs_of(line), BoxesOfStations{boxes_of(line, segment)}} {}

 private:
  static constexpr std::int32_t longest_run = 8;

  /// Runs of stations that follow each other on the wall.
  static std::vector<ItemRun> runs_of(const WallLine& line) {
    std::vector<ItemRun> runs;
    for (std::int32_t i = 0; i < line.size(); ++i) {
      const bool goes_on = i > 0 && line.next(i - 1) == i && i < runs.back().begin + longest_run;
      if (!goes_on) runs.push_back({i, i});
      runs.back().end = i + 1;
    }
    return runs;
  }
  template <class SegmentAt>
  static std::vector<Box> boxes_of(const WallLine& line, const SegmentAt& segment) {
    std::vector<Box> boxes(line.size());
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (const std::optional<Segment> s = segment(i)) boxes[i] = box_of(s->from, s->to);
    }
    return boxes;
  }
};

}  // namespace quadloop
