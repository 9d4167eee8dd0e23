#pragma once

#include <cmath>

#include "mesher/delaunay/tie_order.hpp"

namespace quadloop::test {

/// Any strict order of positions will do, also for nodes on one circle.
inline TieRank rank_of(Point p) { return {-1, -1, std::abs(p.x) + std::abs(p.y), std::abs(p.x), p.x, p.y}; }

}  // namespace quadloop::test
