#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A node of a boundary, by its global number.
struct WallNode {
  std::int64_t number = 0;
  Point at;
};

struct WallEdge {
  WallNode from, to;
};

/// The edges as chains of nodes, each walked the way of its edges: from the end of an open chain, of a loop
/// from the node farthest along x, the lowest of those, which then stands at the end again. In the order in
/// which the edges name the chains.
std::vector<std::vector<WallNode>> walk(const std::vector<WallEdge>& edges);

}  // namespace quadloop
