#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace quadloop::fuzz {

/// One to three loops named "loop" with three to eight corners each, whose coordinates are sixteenths from
/// -0.5 to 1.5; half of them stand within a box from -3 to 4.
std::vector<Chain> loops_from(Bytes& bytes);

}  // namespace quadloop::fuzz
