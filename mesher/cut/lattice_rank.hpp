#pragma once

#include <optional>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// What the lattice's lines through it tell of a node's rank: the numbers of its column and its row.
TieRank line_rank(std::int64_t column, std::int64_t row);

/// The rank of a node where the tree is known: nodes on its lines rank above all others, the coarser the line
/// the higher.
/// With a mirror axis nodes on the same side of it, which are told apart by their coordinates, rank as their
/// images do.
TieRank tie_rank(const Lattice& lattice, int finest_level, Point position,
                 std::optional<MirrorAxis> mirror = {});

}  // namespace quadloop
