#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A directed edge of a plane graph. To its left the winding number is higher by `weight` than to its right.
struct WindingEdge {
  Point from, to;
  int weight = 0;
  std::int32_t origin = 0;  ///< a number of the caller's
};

/// A loop of edges, each by the origin that it has, with the domain to the left.
struct WindingLoop {
  std::vector<Point> points;
  std::vector<std::int32_t> origin;  ///< of the edge from each point to the next one
};

/// The outline of all faces whose winding number is above 0. The edges form one connected graph; two of them
/// have nothing in common but end points, or are equal or opposite. `outside` is the winding number of the
/// unbounded face. Loops are simple, though they may touch at a point, and come in the order of their first
/// origins, each beginning with it. Of equal edges the first one gives the origin.
std::vector<WindingLoop> outline_of_positive(const std::vector<WindingEdge>& edges, int outside);

}  // namespace quadloop
