#pragma once

#include <cstdint>

#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// Whether orient_cells() surely has nothing to turn: all cells run counter-clockwise, and no two have an
/// edge in the same direction. Linear.
bool surely_oriented(const Mesh& mesh, const EdgeTable& table);

/// Turns the cells of a mesh that is whole on this rank so that any two that share an edge run it in opposite
/// directions, and so that in each piece (cells that hang together over edges of two cells) the signed areas
/// add up to more than zero. A cell is therefore counter-clockwise as its neighbours have it: one that moved
/// nodes have inverted stays inverted. Edges of more than two cells join nothing. Pieces that no directions
/// suit (a Moebius strip), or whose areas add up to nothing, stay as they are; validate() has them. The
/// number of cells turned. The nodes that the cells name must exist. O(n log n).
std::int64_t orient_cells(Mesh& mesh);

}  // namespace quadloop
