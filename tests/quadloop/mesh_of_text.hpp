#pragma once

#include <string>

#include "quadloop/quadloop.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// The unit square of one boundary, "side", with cells of 0.1.
inline const std::string unit_square =
    "[[shape]]\nname = \"side\"\nkind = \"polygon\"\npoints = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
    "[spacing]\nmin = 0.02\nmax = 0.1\n[boundary.side]\nbc = \"wall\"\n";

/// The same of two blocks, "west" and "east", with the boundary "between".
inline const std::string square_of_blocks =
    "[[shape]]\nname = \"left\"\nkind = \"curve\"\npoints = [[0.5, 1], [0, 1], [0, 0], [0.5, 0]]\n"
    "[[shape]]\nname = \"right\"\nkind = \"curve\"\npoints = [[0.5, 0], [1, 0], [1, 1], [0.5, 1]]\n"
    "[[shape]]\nname = \"between\"\nkind = \"curve\"\npoints = [[0.5, 0], [0.5, 0.5], [0.5, 1]]\n"
    "[[block]]\nname = \"west\"\nboundaries = [\"left\", \"between\"]\n"
    "[[block]]\nname = \"east\"\nboundaries = [\"right\", \"between\"]\n[spacing]\nmax = 0.1\n";

/// The mesh of a case given as text. *Collective.*
inline Mesh mesh_of_text(const std::string& text) {
  return make_mesh(world(), Case(world(), CaseSource("case", text))).solved.mesh;
}

}  // namespace quadloop::test
