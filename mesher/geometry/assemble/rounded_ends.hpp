#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A repair of input, once, before anything is decided: programs that compute the ends of arcs leave gaps of
/// rounding between pieces which are meant to meet. Of open chains, two loose ends no farther apart along x
/// and along y than 16 units in the last place of the largest coordinate (3.6e-15 of it), and no third one as
/// near, become one point: the later moves onto the earlier, exactly. Likewise points that are as near to the
/// one before are dropped, the last of a closed chain to the first. Warns with how many, and where the first
/// ends were.
void join_rounded_ends(std::vector<Chain>& chains, std::vector<std::string>& warnings);

}  // namespace quadloop
