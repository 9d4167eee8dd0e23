// Points along chains with curves.
#pragma once

#include <vector>

#include "mesher/geometry/curve.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::test {

inline CurvedSegment segment_of(const Chain& chain, std::size_t i) {
  return {chain.points[i], chain.curves.empty() ? Curve{} : chain.curves[i],
          chain.points[(i + 1) % chain.points.size()]};
}

inline std::size_t segments_of(const Chain& chain) { return chain.points.size() - (chain.open ? 1 : 0); }

/// Points along all segments, the ends included.
inline std::vector<Point> along(const Chain& chain) {
  constexpr int pieces = 64;
  std::vector<Point> points;
  for (std::size_t i = 0; i < segments_of(chain); ++i) {
    for (int k = 0; k <= pieces; ++k) points.push_back(point_at(segment_of(chain, i), k / double{pieces}));
  }
  return points;
}

}  // namespace quadloop::test
