#pragma once

#include "flow/euler/model/gas.hpp"

namespace quadloop::flow::euler {

/// The isentropic vortex of strength 5, which the free stream convects unchanged (Yee, Sandham and Djomehri
/// 1999), in a gas of density 1 and speed of sound 1 at infinity; counter-clockwise.
struct Vortex {
  Gas gas;
  State free_stream{};
  Point centre;       ///< at time 0
  double radius = 1;  ///< of the largest rotational speed

  /// Returns the exact flow.
  State state(Point at, double time) const;
};

}  // namespace quadloop::flow::euler
