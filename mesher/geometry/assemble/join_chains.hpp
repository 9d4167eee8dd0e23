#pragma once

#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// Rejects coordinates that are not finite. Drops points that repeat the previous one (in a closed chain also
/// a last point equal to the first), with a warning per boundary, and open chains that are left with one
/// point.
void clean_chains(std::vector<Chain>& chains, std::vector<std::string>& warnings);

/// Joins clean chains into closed loops. Throws InputError for a loose end, for ends of more than two chains
/// at one point, and for a loop with fewer than three distinct points.
Outline join_chains(std::vector<Chain> chains);

}  // namespace quadloop
