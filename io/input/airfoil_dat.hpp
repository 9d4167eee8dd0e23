#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads airfoil coordinates: one row for the name, then either one list around the section from trailing
/// edge to trailing edge (Selig), or two counts and the upper and the lower side from the leading edge
/// (Lednicer). A second row of four numbers is the grid box of MSES. Returns one closed loop "airfoil" with
/// the outside on its left; a repeated trailing edge point is merged, a blunt trailing edge is closed by a
/// segment. Several elements, separated by a row "999. 999.", become loops "airfoil_1", "airfoil_2", ...
std::vector<Chain> read_airfoil(const std::string& path, std::vector<std::string>& warnings);

}  // namespace quadloop::io
