#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/model/point3.hpp"

namespace quadloop {

/// A triangle, whose last corner is -1, or a quad, by places among a polygon's corners, in their order.
using PolygonPiece = std::array<std::int32_t, 4>;

/// Divides a polygon in a plane, with at most most_polygon_corners corners in order, into triangles and
/// convex quads such that the worst of their corners is the best possible, in as few as that allows. Nothing
/// where no division has positive corners alone.
std::vector<PolygonPiece> divide_polygon(std::span<const Point3> corners);

inline constexpr std::size_t most_polygon_corners = 32;

}  // namespace quadloop
