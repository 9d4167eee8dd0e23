#pragma once

#include <span>
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

/// Returns points from the trailing edge over the upper surface and back along the lower one as the text of a
/// `.dat` file in Selig's format, which reads back to the same coordinates.
std::string airfoil_text(const std::string& title, std::span<const Point> points);

}  // namespace quadloop::io
