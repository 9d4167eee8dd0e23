#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A directed edge of a planar graph. The winding number on its left is higher by `weight` than on its right.
struct WindingEdge {
  Point from, to;
  int weight = 0;
  std::int32_t origin = 0;  ///< a number defined by the caller
};

/// A loop of edges, each with its origin, with the domain to the left.
struct WindingLoop {
  std::vector<Point> points;
  std::vector<std::int32_t> origin;  ///< of the edge from each point to the next one
};

/// The boundary of all faces with a positive winding number. The edges must form one connected graph; two
/// edges share only end points, or are equal or opposite. `outside` is the winding number of the unbounded
/// face. Loops are simple but may touch at a point. They are sorted by their first origins, and each begins
/// with its first origin. Equal edges have the origin of the first one.
std::vector<WindingLoop> outline_of_positive(const std::vector<WindingEdge>& edges, int outside);

}  // namespace quadloop
