#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A triangle between two adjacent polylines: an edge of one and the opposite point of the other.
struct ZipperTriangle {
  bool on_first = false;               ///< the edge is on the first polyline
  std::int32_t first = 0, second = 0;  ///< points: where the edge begins, and the opposite one
};

/// Triangulates the strip between two polylines, from the edge between their first points to the edge between
/// their last points, in that order. Minimises the sum of 1 / q with the quality q = 4 sqrt(3) area / (sum of
/// squared edges). `left`: the second polyline is to the left of the first. They may share their first point.
/// O(nm) for n and m points.
std::vector<ZipperTriangle> zipper(std::span<const Point> first, std::span<const Point> second, bool left);

}  // namespace quadloop
