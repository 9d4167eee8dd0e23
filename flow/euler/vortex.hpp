#pragma once

#include "flow/euler/model/gas.hpp"

namespace quadloop::euler {

/// The isentropic vortex of strength 5 that the free stream carries along unchanged (Yee, Sandham and
/// Djomehri 1999), in a gas of density 1 and speed of sound 1 far away; it turns counter-clockwise.
struct Vortex {
  Gas gas;
  State free_stream{};
  Point centre;       ///< at time 0
  double radius = 1;  ///< where it turns fastest

  /// The exact flow.
  State state(Point at, double time) const;
};

}  // namespace quadloop::euler
