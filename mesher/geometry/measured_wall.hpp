#pragma once

#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A straight piece of a wall, walked with the domain to its left, and what a flow has measured at its ends:
/// how many wall units (viscous lengths nu / u_tau) go into a unit of the geometry's length, which is y+ at
/// that height. 0 where there is no friction.
struct MeasuredEdge {
  Point from, to;
  double wall_units_from = 0, wall_units_to = 0;

  friend bool operator==(const MeasuredEdge&, const MeasuredEdge&) = default;
};

/// The walls of an earlier mesh; the same on every rank. Empty: nothing was measured.
using MeasuredWall = std::vector<MeasuredEdge>;

}  // namespace quadloop
