#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/triangle_piece.hpp"

namespace quadloop {

/// For each point the index of the triangle that it lies in, its rim included, by exact predicates; of
/// several the one with the lowest number; -1 where there is none. The triangles are counter-clockwise. O((n
/// + m) log n).
std::vector<std::int32_t> locate_points(const TrianglePiece& piece, std::span<const Point> points);

}  // namespace quadloop
