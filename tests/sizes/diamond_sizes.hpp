#pragma once

#include <span>
#include <vector>

#include "mesher/geometry/interior.hpp"
#include "mesher/sizes/demanded_splits.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop::test {

/// A void by its middle and how far its four corners lie from there.
struct Diamond {
  Point centre;
  double reach;
};

/// A square of edge 2 round the origin, with boundary `frame`, and the diamond's, each with four segments.
inline Geometry diamond_in_square(const Diamond& diamond, const Boundary& frame, const Boundary& wall) {
  const Point c = diamond.centre, right{diamond.reach, 0}, up{0, diamond.reach};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  boundary.resize(8, BoundaryId{1});
  return {{frame, wall},
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, c - up, c - right, c + up, c + right},
          {0, 4, 8},
          boundary};
}

/// What a tree of the wanted sizes of a diamond in a square stands on; no leaf is unresolved.
struct DiamondSizes {
  /// The diamond's sides ask for leaves of `spacing`; its corners are kept if they turn by more than `corner`
  /// degrees.
  DiamondSizes(const Diamond& diamond, double spacing, double min, double max, double corner = 30)
      : geometry{diamond_in_square(diamond, {"frame", 0.5, 30, "none"}, {"wall", spacing, corner, "wall"})} {
    options.min = min;
    options.max = max;
  }

  Geometry geometry;
  ShiftedOutline outline{geometry};
  Interior inside{outline};
  TreeGrid grid{Box{{-1.5, -1.5}, {1.5, 1.5}}, 1, 1};
  DemandedSplits demanded;
  SizeOptions options;

  SizeTree tree() const {
    return {outline, grid, options, [](const Quadrant&, std::span<const std::int32_t>) { return false; },
            demanded};
  }
  SizedQuadrant at(const Quadrant& q, std::span<const std::int32_t> segments = {}) const {
    return {q, grid.box_of(q), segments, {}, false, false};
  }
};

/// Leaves of one size at a large diamond, in the square's upper right quarter.
struct LargeDiamondSizes : DiamondSizes {
  explicit LargeDiamondSizes(double spacing) : DiamondSizes({{0.6, 0.6}, 0.37}, spacing, spacing, 0.5) {}
};

}  // namespace quadloop::test
