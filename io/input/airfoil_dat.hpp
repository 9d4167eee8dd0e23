#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Reads airfoil coordinates, one row for the name and then either one list around the section from trailing
/// edge to trailing edge (Selig), or two counts and the upper and the lower side from the leading edge on
/// (Lednicer). A second row of four numbers is the box of MSES' grid. Gives one closed loop "airfoil" with
/// the outside to its left; a trailing edge given twice is one point, a blunt one is closed by a segment.
/// Several elements, divided by a row "999. 999.", are the loops "airfoil_1", "airfoil_2", ...
std::vector<Chain> read_airfoil(const std::string& path, std::vector<std::string>& warnings);

}  // namespace quadloop
