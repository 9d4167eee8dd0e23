#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Constrained Delaunay triangulation of the region between loops of any number of nodes: outer loops
/// counter-clockwise, holes clockwise, which meet only at nodes or pass an edge in both directions. Appends
/// counter-clockwise triangles. For cocircular points the choice is arbitrary.
void triangulate_region(std::span<const Point> points, std::span<const std::span<const std::int32_t>> loops,
                        std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace quadloop
