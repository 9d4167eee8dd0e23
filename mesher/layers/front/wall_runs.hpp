#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A stretch of the outline that carries layers, in walking order: a whole loop, or a part of one that ends
/// on boundaries without layers.
struct WallRun {
  bool closed = false;
  std::vector<std::int32_t> segments;  ///< of the geometry, each following the one before
  std::vector<BoundaryId> layers;      ///< of each segment: the boundary whose layers it carries
};

/// All of them, in the order of the outline. A stretch ends only where the next boundary leaves it at 45 to
/// 135 degrees, so that the last column can lie on that boundary; elsewhere the layers go on along the next
/// boundary, up to its first corner of such an angle: a stack of thin cells never ends in the open. The
/// segments `bare`, at which wakes begin, have none either. Throws InputError where boundaries that meet ask
/// for different numbers of layers.
std::vector<WallRun> wall_runs(const Geometry& geometry, const std::vector<std::int32_t>& bare = {});

/// The direction of a segment, of length 1; that of the reversed segment is its negative, to the last bit.
Point direction_of(Point from, Point to);

}  // namespace quadloop
