#pragma once

#include <vector>

#include "mesher/geometry/measured_flow.hpp"
#include "mesher/layers/front/adapted_size.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The layers of each station when first heights follow a measured flow. Where the boundary has a y+ target,
/// the first height is that of the nearest place of the measured wall with the same direction. It is limited
/// to 0.1 to 10 times the boundary's estimate and to the height of equal layers. Along the wall a height
/// grows by at most 0.6 of itself per thickness of the layers (a fifth from column to column), so that
/// heights stay small where friction vanishes: at stagnation and separation points. Number and total
/// thickness are kept (with_first_height()), unless the boundary's thickness follows the flow
/// (LayerSpec::follows_flow): then it is 1.2 times that of the boundary layer at the nearest measured place,
/// as far as growth ratios allow (with_thickness()), and within 0.1 to 10 times the boundary's estimate.
/// Where adaptation requests larger cells, `adapted`, the layers continue outside the boundary layer until
/// the last one is as high as these cells or the thickness is the estimate. Other boundaries are unchanged.
/// Where no measured edge has the same direction, and where the thickness is unknown, the estimate is used.
/// Depends on its arguments only; mirror images have mirrored results.
///
/// The factor: in a turbulent flat-plate flow of SU2 (Spalart-Allmaras) the eddy viscosity at 1.2 times the
/// measured thickness is below 3 % of its maximum, at the thickness itself 7 %, and the velocity is above
/// 99.9 %.
std::vector<LayerSpec> followed_layers(const WallLine& line, const MeasuredFlow& measured,
                                       const AdaptedSize& adapted = {});

}  // namespace quadloop
