#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A repair of input, once, before anything is decided: programs that compute the ends of arcs leave gaps of
/// rounding between pieces which are meant to meet, and drawings have lines twice. Of open chains, two loose
/// ends that are no farther apart along x and along y than `share` of the extent, or 16 units in the last
/// place of the largest coordinate (3.6e-15 of it), and no third one as near, become one point: the later
/// moves onto the earlier, exactly. Points that are as near as rounding to the one before are dropped, the
/// last of a closed chain to the first. Of chains of one name that have the same points, either way round,
/// the first stays. Warns with how many, and where the first were.
void join_rounded_ends(std::vector<Chain>& chains, double share, std::vector<std::string>& warnings);

}  // namespace quadloop
