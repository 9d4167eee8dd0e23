#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop::flow {

/// A node of a boundary, by its global number.
struct WallNode {
  std::int64_t number = 0;
  Point at;
};

struct WallEdge {
  WallNode from, to;
};

/// Returns the edges as chains of nodes in the direction of the edges: an open chain from its end, a loop
/// from the node of largest x, the lowest of those, which is repeated at the end. Chains are in the order of
/// the edges.
std::vector<std::vector<WallNode>> walk(const std::vector<WallEdge>& edges);

}  // namespace quadloop::flow
