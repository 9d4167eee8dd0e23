#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// An airfoil of unit chord with a NACA section (NacaSection) and a plain flap: the part behind the hinge is
/// turned about it, and an arc about the hinge closes the gap on the outer side of the bend.
struct NacaAirfoil {
  std::string code;
  bool sharp = true;        ///< both surfaces end in one point
  double flap_degrees = 0;  ///< positive: trailing edge down
  /// Its place on the chord, 0 to 1, on the camber line; or its x and y.
  std::vector<double> hinge{0.75};
  int points = 201;  ///< on each surface, without those of the arc

  friend bool operator==(const NacaAirfoil&, const NacaAirfoil&) = default;
};

/// The outline, clockwise from the trailing edge along the lower surface to the leading edge and back along
/// the upper one, as smooth parts: each begins with the last point of the one before, and the last ends with
/// the first point of the first. Two points are a line, the base of a blunt trailing edge. Throws InputError
/// for a wrong code, a hinge outside the section and an angle to which the flap cannot turn.
std::vector<std::vector<Point>> smooth_parts(const NacaAirfoil& airfoil);

}  // namespace quadloop
