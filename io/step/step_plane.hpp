#pragma once

#include <span>
#include <string>

#include "io/step/step_model.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// A plane parallel to a coordinate plane.
struct StepPlane {
  int first = 0, second = 1;  ///< axes of space that are x and y in the plane
  double extent = 0;          ///< largest side of the box of all curves

  /// "XY", "XZ" or "YZ".
  std::string name() const;
  Point project(const SpacePoint& p) const { return {p.at[first], p.at[second]}; }
};

/// The plane of the curves, to 1e-6 of their extent. Throws InputError with two entities and coordinates if
/// there is none.
StepPlane plane_of(std::span<const StepCurve> curves);

/// The curve in the plane: a closed chain has three points or more. Its name is not set.
Chain chain_in(const StepPlane& plane, const SpaceCurve& curve);

}  // namespace quadloop::io
