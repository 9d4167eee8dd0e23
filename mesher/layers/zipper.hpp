#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A triangle between two polylines that run side by side: on an edge of one of them, opposite to a point of
/// the other.
struct ZipperTriangle {
  bool on_first = false;               ///< whether the edge is one of the first polyline
  std::int32_t first = 0, second = 0;  ///< points: where the edge begins, and the one opposite to it
};

/// The triangles that fill the strip between two polylines, in their order along it, from the edge between
/// their first points to that between their last ones: of all ways the one with the least sum of
/// 1 / (4 sqrt(3) area / sum of squared edges). `left` says whether the second polyline lies to the left of
/// the first. They may begin at one point. O(nm) for n and m points.
std::vector<ZipperTriangle> zipper(std::span<const Point> first, std::span<const Point> second, bool left);

}  // namespace quadloop
