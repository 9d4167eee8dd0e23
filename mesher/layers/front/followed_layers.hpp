#pragma once

#include <vector>

#include "mesher/geometry/measured_flow.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The layers of each station when first heights follow a measured flow. Where the boundary has a y+ target,
/// the first height is that of the nearest place of the measured wall with the same direction. It is limited
/// to 0.1 to 10 times the boundary's estimate and to the height of equal layers. Along the wall a height
/// grows by at most 0.6 of itself per thickness of the layers (a fifth from column to column), so that
/// heights stay small where friction vanishes: at stagnation and separation points. Number and total
/// thickness are kept (with_first_height()). Other boundaries are unchanged. Where no segment of the measured
/// wall has the same direction the estimate is used. Depends on its arguments only; mirror images have
/// mirrored results.
std::vector<LayerSpec> followed_layers(const WallLine& line, const MeasuredWall& measured);

}  // namespace quadloop
