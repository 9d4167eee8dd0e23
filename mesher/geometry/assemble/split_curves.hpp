#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Which chains are split where they meet.
enum class SplitChains {
  all,          ///< any two
  inner_lines,  ///< an inner line and any other chain, or itself
};

/// Splits curves where they cross, or where an end of another chain lies on them, together with the segments
/// that they cross: afterwards the pieces of two chains meet in common ends. Distances up to `near` count as
/// 0: an end of an inner line moves onto the curve, a curve bends to other ends. Equal curves are split in
/// the same way; curves that touch over a length are left as they are. A piece requests the cells that the
/// whole curve does.
void split_curves_at_crossings(std::vector<Chain>& chains, double near = 0,
                               SplitChains which = SplitChains::all);

}  // namespace quadloop
