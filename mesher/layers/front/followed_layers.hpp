#pragma once

#include <vector>

#include "mesher/geometry/measured_wall.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The layers that each station asks for when first heights follow a measured flow: where its boundary wants
/// a y+, the height at which the nearest place of the measured wall (one that runs the same way) has it,
/// within a tenth and ten times of the estimate that the boundary has, and of the thickness at most its share
/// of an equal layer; along the wall a height grows by at most 0.6 of itself over a thickness of the layers,
/// a fifth from column to column, so that heights stay small where friction vanishes: at a stagnation point
/// or where the flow separates. Number and total thickness stay (with_first_height()). Other boundaries keep
/// theirs. Where no piece of the measured wall runs the same way the estimate stands. A function of its
/// arguments alone, with mirrored results for mirror images.
std::vector<LayerSpec> followed_layers(const WallLine& line, const MeasuredWall& measured);

}  // namespace quadloop
