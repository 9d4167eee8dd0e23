#pragma once

#include <vector>

#include "mesher/layers/front/adapted_size.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The thickness of the layers of each station with which the last layer is at most 1.4 times as high as the
/// cells that adaptation requests between the wall and the front; at most as requested. Where the thickness
/// follows the flow (LayerSpec::follows_flow), only cells in the outer fifth of the layers count.
std::vector<double> adapted_thickness(const WallLine& line, const AdaptedSize& adapted);

}  // namespace quadloop
