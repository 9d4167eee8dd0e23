#include "mesher/geometry/segment_tree.hpp"

#include <algorithm>
#include <vector>

namespace quadloop {

namespace {

constexpr std::int32_t longest_run = 16;

/// Runs within one loop each.
std::vector<ItemRun> runs_of(const Geometry& geometry) {
  std::vector<ItemRun> runs;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    const std::int32_t end = geometry.loop_start(loop + 1);
    for (std::int32_t s = geometry.loop_start(loop); s < end; s += longest_run)
      runs.push_back({s, std::min(s + longest_run, end)});
  }
  return runs;
}

}  // namespace

SegmentTree::SegmentTree(const Geometry& geometry) : RunTree{runs_of(geometry), BoxesOfSegments{&geometry}} {}

}  // namespace quadloop
