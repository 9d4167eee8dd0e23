#pragma once

#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// Refuses coordinates that are not finite; drops points that repeat the one before (the last may not repeat
/// the first of a closed chain either), with a warning for each boundary; and open chains of which one point
/// is left.
void clean_chains(std::vector<Chain>& chains, std::vector<std::string>& warnings);

/// Joins clean chains into closed loops. Throws InputError for a loose end, for ends of more than two chains
/// at one point, and for a loop of fewer than three distinct points.
Outline join_chains(std::vector<Chain> chains);

}  // namespace quadloop
