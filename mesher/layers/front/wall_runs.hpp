#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A stretch of the geometry with layers, in loop order: a whole loop, or a part of one that ends on
/// boundaries without layers.
struct WallRun {
  bool closed = false;
  std::vector<std::int32_t> segments;  ///< of the geometry, in order
  std::vector<BoundaryId> layers;      ///< for each segment the boundary that specifies its layers
};

/// All runs, in the order of the geometry. A run ends only where the next boundary leaves it at 45 to 135
/// degrees, so that the last column can lie on that boundary. Elsewhere the layers continue along the next
/// boundary up to its first corner of such an angle, so that layers never end in the interior. The segments
/// `bare`, at which wakes begin, have no layers. Throws InputError if adjacent boundaries have different
/// numbers of layers.
std::vector<WallRun> wall_runs(const Geometry& geometry, const std::vector<std::int32_t>& bare = {});

/// The unit direction of a segment; that of the reversed segment is its exact negative.
Point direction_of(Point from, Point to);

}  // namespace quadloop
