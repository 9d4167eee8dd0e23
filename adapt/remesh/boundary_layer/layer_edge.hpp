#pragma once

#include <optional>
#include <span>

namespace quadloop::adapt {

/// The flow at a distance from a wall along its normal.
struct ProfileSample {
  double height = 0;    ///< distance from the wall, positive
  double velocity = 0;  ///< component along the wall, to the right of the normal
  double shear = 0;     ///< minus the vorticity: in a boundary layer d velocity / d height
};

/// The distance from the wall to the edge of the boundary layer: where F = height * |vorticity|, the function
/// of Baldwin and Lomax (AIAA 78-257) without its damping near the wall, has fallen to a fifth of its
/// maximum. F does not depend on the velocity outside, which varies beyond the edge. Stock and Haase (AIAA
/// Journal 27(1), 1989, pages 5-14) derive the edge from the place of the maximum, by factors that differ for
/// laminar and turbulent flow; the place of the decay is the same multiple of the thickness in both within
/// 5 %, and varies less from one column of cells to the next, as the maximum is flat. Vorticity of the other
/// sign ends the layer, so that the wake of a body upstream does not belong to it.
///
/// `profile`: samples by increasing height. Empty if F does not fall so far, if the velocity changes its sign
/// below the edge (separated flow), or if F at the maximum is below 3 % of the velocity at the edge (no
/// boundary layer).
std::optional<double> layer_edge(std::span<const ProfileSample> profile);

}  // namespace quadloop::adapt
