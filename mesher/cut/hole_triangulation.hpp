#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A constrained Delaunay triangulation of the region between loops of any number of nodes: outlines
/// counter-clockwise, holes clockwise, which do not meet but at nodes. Appends counter-clockwise triangles.
/// Ties between points on one circle fall anyhow.
void triangulate_region(std::span<const Point> points, std::span<const std::span<const std::int32_t>> loops,
                        std::vector<std::array<std::int32_t, 3>>& triangles);

}  // namespace quadloop
