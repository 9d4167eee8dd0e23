#pragma once

#include "mesher/grid/tree_grid.hpp"

namespace quadloop::test {

/// Of 3 by 2 trees, each of edge 1.
inline const TreeGrid brick({{0, 0}, {3, 2}}, 3, 2);

}  // namespace quadloop::test
