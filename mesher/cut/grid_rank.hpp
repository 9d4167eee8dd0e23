#pragma once

#include <optional>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// Returns the part of a node's rank that follows from the grid lines through it, given by column and row
/// number.
TieRank line_rank(std::int64_t column, std::int64_t row);

/// Returns the rank of a node for a known tree: nodes on its lines rank above all others, coarser lines
/// higher. With a mirror axis nodes on the same side of it, which are distinguished by their coordinates,
/// rank as their images do.
TieRank tie_rank(const TreeGrid& grid, int finest_level, Point position,
                 std::optional<MirrorAxis> mirror = {});

}  // namespace quadloop
