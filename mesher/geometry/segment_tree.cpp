#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t longest_run = 16;

}  // namespace

SegmentTree::SegmentTree(const Geometry& geometry) : geometry_{&geometry} {
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    for (std::int32_t s = geometry.loop_start(loop); s < geometry.loop_start(loop + 1); s += longest_run)
      starts_.push_back(s);
  }
  starts_.push_back(geometry.size());
  runs_ = BoxTree(size32(starts_) - 1, [&](std::int32_t run) {
    Box box;
    for (std::int32_t s = starts_[run]; s < starts_[run + 1]; ++s) {
      box.include(geometry.point(s));
      box.include(geometry.point(geometry.next(s)));
    }
    return box;
  });
}

}  // namespace quadloop
