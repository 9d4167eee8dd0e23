#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// A loop of an outline, with points added where other loops meet it. Piece i runs from points[i] to the next
/// point.
struct SplitLoop {
  std::vector<Point> points;
  std::vector<std::int32_t> segment;  ///< of each piece: the segment of the outline's loop that it is part of
};

/// Splits all loops where they cross, touch or overlap, so that two pieces of the result have nothing in
/// common but end points, or are equal. A point within `near` of another loop's point or segment (along each
/// axis, or to the segment) counts as lying on it: later points move onto earlier ones, and segments bend to
/// points. Crossings are rounded once. Decided by exact predicates on the rounded coordinates, until nothing
/// is left to split. Each loop is simple. Throws InputError, with a place, where no end is found.
std::vector<SplitLoop> split_loops(const Outline& outline, double near);

}  // namespace quadloop
