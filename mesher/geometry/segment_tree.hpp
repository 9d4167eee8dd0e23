#pragma once

#include <cstdint>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/run_tree.hpp"

namespace quadloop {

/// The box of each segment's chord.
struct BoxesOfSegments {
  const Geometry* geometry;

  Box operator()(std::int32_t s) const {
    return box_of(geometry->point(s), geometry->point(geometry->next(s)));
  }
};

/// Finds the segments of a geometry whose boxes meet a box: 4 bytes per segment. The geometry must outlive
/// it.
class SegmentTree : public RunTree<BoxesOfSegments> {
 public:
  explicit SegmentTree(const Geometry& geometry);
};

}  // namespace quadloop
