#pragma once

#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A straight piece of a wall, with the domain to its left, and the friction measured at its ends: the number
/// of wall units (viscous lengths nu / u_tau) per unit of length, i.e. y+ at unit height. 0 where there is no
/// friction.
struct MeasuredEdge {
  Point from, to;
  double wall_units_from = 0, wall_units_to = 0;

  friend bool operator==(const MeasuredEdge&, const MeasuredEdge&) = default;
};

/// The walls of an earlier mesh; the same on every rank. Empty: no measurement.
using MeasuredWall = std::vector<MeasuredEdge>;

}  // namespace quadloop
