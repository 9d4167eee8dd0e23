#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Splits curves where they cross, or where an end of another chain lies on them, together with the segments
/// that they cross: afterwards the pieces of two chains meet in common ends. Equal curves, and curves that
/// touch over a length, are left as they are.
void split_curves_at_crossings(std::vector<Chain>& chains);

}  // namespace quadloop
