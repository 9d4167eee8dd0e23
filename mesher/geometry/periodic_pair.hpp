#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Two boundaries that a translation or a rotation maps onto each other: the flow that leaves the domain
/// through one of them enters it through the other. The rotation is applied first; one of the two is the
/// identity.
struct PeriodicPair {
  std::string from, to;
  Point translation;
  double degrees = 0;  ///< counter-clockwise, about `centre`
  Point centre = {};

  bool rotates() const { return degrees != 0; }
  /// The point on `to` that belongs to a point on `from`.
  Point image(Point p) const;
  /// The point on `from` whose image is p, up to rounding.
  Point source(Point p) const;

  friend bool operator==(const PeriodicPair&, const PeriodicPair&) = default;
};

}  // namespace quadloop
