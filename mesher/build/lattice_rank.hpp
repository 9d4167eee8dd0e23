#pragma once

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/forest/lattice.hpp"

namespace quadloop {

/// The rank of a node where the tree is known: nodes on its lines rank above all others, the coarser the line
/// the higher.
TieRank tie_rank(const Lattice& lattice, int finest_level, Point position);

}  // namespace quadloop
