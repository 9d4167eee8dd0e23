#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Repairs the input before all other checks: computed ends of arcs leave gaps of rounding size between
/// chains that should meet, and drawings contain duplicate lines. Two loose ends of open chains are joined if
/// their distance along x and along y is at most `share` of the extent, or 16 units in the last place of the
/// largest coordinate (3.6e-15 of it), and no third end is as near; the later end moves exactly onto the
/// earlier. Throws InputError for an end that is as near to several others. Points within rounding of the
/// previous one are dropped, in a closed chain also a last point near the first. Of chains of one name with
/// the same points and curves, in either direction, the first is kept; open chains that repeat segments of
/// longer ones of their name, such as a line over an edge of a polyline, are dropped. Warns with the number
/// of repairs and the first places.
void join_rounded_ends(std::vector<Chain>& chains, double share, std::vector<std::string>& warnings);

}  // namespace quadloop
