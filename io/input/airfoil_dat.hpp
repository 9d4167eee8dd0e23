#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Reads airfoil coordinates, one row for the name and then either one list around the section from trailing
/// edge to trailing edge (Selig), or two counts and the upper and the lower side from the leading edge on
/// (Lednicer). Gives one closed loop "airfoil" with the outside to its left; a trailing edge given twice is
/// one point, a blunt one is closed by a segment.
std::vector<Chain> read_airfoil(const std::string& path, std::vector<std::string>& warnings);

}  // namespace quadloop
