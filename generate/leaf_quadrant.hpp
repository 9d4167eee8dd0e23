#pragma once

#include <cstdint>

#include "mesher/grid/tree_grid.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Returns the square of a stored quadtree cell.
inline Quadrant quadrant_of(const LeafRecord& leaf) {
  return {(std::int64_t{leaf.tree_x} << Quadrant::unit_level) + leaf.x,
          (std::int64_t{leaf.tree_y} << Quadrant::unit_level) + leaf.y, leaf.level};
}

}  // namespace quadloop
