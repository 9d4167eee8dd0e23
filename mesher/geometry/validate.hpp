#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// The nesting of one loop among the others.
struct LoopNesting {
  std::int32_t depth = 0;          ///< number of loops around it
  std::int32_t parent = -1;        ///< the innermost of them; -1: none
  bool counter_clockwise = false;  ///< direction in the input
};

/// Checks that segments meet only where allowed: neighbours at their common point, and two loops at a point
/// of both where they do not cross. There must be no crossing, no other contact, no spike of zero width.
/// Exact, O(n log n). Returns the nesting of the loops. Throws InputError with the first pair that meets, in
/// the order of input, and the number of further pairs. Loops have at least three points, without consecutive
/// duplicates. `remedy_of_two` is appended to the message if two loops meet.
std::vector<LoopNesting> validate(const Outline& outline, const std::string& remedy_of_two = "");

}  // namespace quadloop
