#pragma once

#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A wall edge, with the domain to its left, and the wall friction of the last solution at its ends: the
/// number of wall units (viscous lengths nu / u_tau) per unit of length, i.e. y+ at unit height. 0 without
/// friction.
struct MeasuredEdge {
  Point from, to;
  double wall_units_from = 0, wall_units_to = 0;

  friend bool operator==(const MeasuredEdge&, const MeasuredEdge&) = default;
};

/// The walls of an earlier mesh with the friction of its solution; the same on every rank. Empty: none is
/// known.
using MeasuredWall = std::vector<MeasuredEdge>;

/// A wall edge, with the domain to its left, and the thickness of the boundary layer in the last solution at
/// its ends, in the geometry's unit of length. 0 where it is unknown, at both ends.
struct MeasuredThickness {
  Point from, to;
  double at_from = 0, at_to = 0;

  friend bool operator==(const MeasuredThickness&, const MeasuredThickness&) = default;
};

/// What the solution on an earlier mesh tells the layers of the next one; the same on every rank.
struct MeasuredFlow {
  MeasuredWall walls;
  /// Streamlines for wakes that follow the flow, each from the trailing edge on.
  std::vector<std::vector<Point>> wakes;

  /// For walls whose layers follow the boundary layer.
  std::vector<MeasuredThickness> thickness;

  bool empty() const { return walls.empty() && wakes.empty() && thickness.empty(); }
  friend bool operator==(const MeasuredFlow&, const MeasuredFlow&) = default;
};

}  // namespace quadloop
