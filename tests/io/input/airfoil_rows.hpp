#pragma once

#include <string>

namespace quadloop::test {

inline const std::string airfoil_name = "NACA 0012\n";

/// The way round, from the trailing edge over the upper side.
inline const std::string selig_rows = "1.0 0.0\n0.5 0.06\n0.0 0.0\n0.5 -0.06\n1.0 0.0\n";

/// Each side from the leading edge, after the numbers of their points.
inline const std::string upper_rows = "0.0 0.0\n0.5 0.06\n1.0 0.0\n";
inline const std::string lower_rows = "0.0 0.0\n0.5 -0.06\n1.0 0.0\n";
inline const std::string lednicer_rows = "3. 3.\n\n" + upper_rows + "\n" + lower_rows;

}  // namespace quadloop::test
