#pragma once

#include <optional>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::adapt {

/// Two geometries of the same pieces, before and after a change. Each piece is a loop; an open one is closed
/// by a segment without boundary name. Pieces that coincide are walked in the same direction, so that their
/// arc lengths agree bitwise.
struct OutlinePieces {
  Geometry from, to;
};

/// Returns the pieces of two lists of chains that correspond one to one: as many, with the same names and
/// numbers of points, in the same order. Empty if they do not.
std::optional<OutlinePieces> pieces_of(std::vector<Chain> from, std::vector<Chain> to);

}  // namespace quadloop::adapt
