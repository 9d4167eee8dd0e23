#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/model/point3.hpp"

namespace quadloop::io {

/// A triangle, whose last corner is -1, or a quad, as indices of a polygon's corners, in their order.
using PolygonPiece = std::array<std::int32_t, 4>;

/// Divides a plane polygon with at most most_polygon_corners corners, in order, into triangles and convex
/// quads such that the worst of their corner angles is optimal, with as few pieces as that allows. Empty if
/// no division has only positive corners.
std::vector<PolygonPiece> divide_polygon(std::span<const Point3> corners);

inline constexpr std::size_t most_polygon_corners = 32;

}  // namespace quadloop::io
