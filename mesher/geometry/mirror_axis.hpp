#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The coordinate axis of a mirror symmetry: reflection in the x-axis negates y, in the y-axis x.
enum class MirrorAxis : char { x, y };

/// The exact mirror image; 0 remains +0.
constexpr Point image_of(MirrorAxis axis, Point p) {
  return axis == MirrorAxis::x ? Point{p.x, 0.0 - p.y} : Point{0.0 - p.x, p.y};
}

/// The nearest point of the axis.
constexpr Point foot_on(MirrorAxis axis, Point p) {
  return axis == MirrorAxis::x ? Point{p.x, 0} : Point{0, p.y};
}

/// The coordinate that changes its sign.
constexpr double height_over(MirrorAxis axis, Point p) { return axis == MirrorAxis::x ? p.y : p.x; }

/// -1, 0 (on the axis) or 1, the side that is meshed and smoothed; the other side is its image.
constexpr int side_of(MirrorAxis axis, Point p) {
  const double height = height_over(axis, p);
  return height < 0 ? -1 : height > 0 ? 1 : 0;
}

constexpr const char* name_of(MirrorAxis axis) { return axis == MirrorAxis::x ? "x" : "y"; }

}  // namespace quadloop
