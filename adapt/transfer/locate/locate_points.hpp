#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/triangle_piece.hpp"

namespace quadloop::adapt {

/// Whether a counter-clockwise triangle contains a point, border included; exact.
bool contains(const std::array<Point, 3>& corners, Point p);

/// For each point the index of the triangle that contains it, border included, by exact predicates; the
/// lowest number of several; -1 if there is none. The triangles must be counter-clockwise. O((n + m) log n).
std::vector<std::int32_t> locate_points(const TrianglePiece& piece, std::span<const Point> points);

}  // namespace quadloop::adapt
