#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// A loop with points added where other loops meet it. Piece i runs from points[i] to the next point.
struct SplitLoop {
  std::vector<Point> points;
  std::vector<std::int32_t> segment;  ///< for each piece the segment of the original loop that contains it
  bool open = false;                  ///< a line, without a piece from its last point to the first
};

/// Splits all loops where they cross, touch or overlap, so that two pieces are equal or share only end
/// points. A point within `near` (along each axis) of another loop's point, or within `near` of a segment,
/// counts as lying on it: later points move onto earlier ones, and segments bend to points. Crossings are
/// rounded once. Uses exact predicates on the rounded coordinates and repeats until nothing is left to split.
/// Each loop must be simple. Throws InputError with a place if the process does not terminate.
std::vector<SplitLoop> split_loops(const Outline& outline, double near);
/// Same for loops and lines.
std::vector<SplitLoop> split_lines(std::span<const Chain> chains, double near);

}  // namespace quadloop
