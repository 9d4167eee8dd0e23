#pragma once

#include <vector>

#include "io/plot/value_raster.hpp"

namespace quadloop {

/// Lines along a velocity that a picture shows, in places of the sheet: about `count` of them across its
/// shorter side, evenly spread (Jobard and Lefer 1997: each begins beside an earlier one, and ends where it
/// comes close to one). `x_velocity` and `y_velocity` cover the same box; y of the sheet runs downwards, the
/// velocity's upwards. Each line runs the way of the flow.
std::vector<std::vector<Point>> streamlines(const ValueRaster& x_velocity, const ValueRaster& y_velocity,
                                            int count);

}  // namespace quadloop
