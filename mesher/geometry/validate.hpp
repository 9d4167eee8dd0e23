#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// How one loop lies among the others.
struct LoopNesting {
  std::int32_t depth = 0;          ///< number of loops around it
  std::int32_t parent = -1;        ///< the innermost of them; -1: none
  bool counter_clockwise = false;  ///< as it is given
};

/// Checks that no two segments of the outline meet but neighbours at their common point, and those of two
/// loops at a point of both where these do not cross: no crossing, no other touching, no spike of zero width.
/// Exact, O(n log n). Returns how the loops are nested. Throws InputError that names the first pair that
/// meets, in the order of input, and says how many others there are. Loops have three points or more, none
/// repeated in a row. `remedy_of_two` ends the message where two loops meet.
std::vector<LoopNesting> validate(const Outline& outline, const std::string& remedy_of_two = "");

}  // namespace quadloop
