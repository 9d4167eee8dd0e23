#pragma once

#include <vector>

#include "io/plot/value_raster.hpp"

namespace quadloop::io {

/// Returns streamlines in coordinates of the sheet: about `count` of them across its shorter side, evenly
/// distributed (Jobard and Lefer 1997: each starts beside an earlier one, and ends where it approaches one).
/// `x_velocity` and `y_velocity` cover the same box; the y axis of the sheet points downwards, that of the
/// velocity upwards. Lines are directed along the flow.
std::vector<std::vector<Point>> streamlines(const ValueRaster& x_velocity, const ValueRaster& y_velocity,
                                            int count);

}  // namespace quadloop::io
