#pragma once

#include <optional>
#include <span>

#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/snap/capture_points.hpp"
#include "mesher/snap/corner_sights.hpp"

namespace quadloop {

/// A grid vertex with the crossings that it sees.
struct SightedCorner {
  GridPoint corner;
  Point position;   ///< position on the grid
  double edge = 0;  ///< shortest leaf edge there
  std::span<const Sight> sights;
  /// For a mirror-symmetric mesh: a vertex on the axis moves only along it. Of equally near places the choice
  /// is symmetric for mirror images.
  std::optional<MirrorAxis> mirror = {};
};

/// Decides whether and where a grid vertex moves that has a crossing nearer than `share` of the shortest edge
/// there. The move is a contraction: on each edge from the vertex the nearest crossings are absorbed, all of
/// one run of the boundary, so that the leaves around are still cut in the same pattern. A vertex that would
/// absorb two runs, or swallow a kept point, stays.
std::optional<Snap> snap_corner(const Geometry& geometry, const LeafTraces& traces,
                                const SightedCorner& corner, double share);

/// Moves a grid vertex to the point that captures it and absorbs the crossings of that point's run as far as
/// possible. If that is impossible and the vertex has other near crossings, these decide.
std::optional<Snap> snap_captured(const Geometry& geometry, const LeafTraces& traces,
                                  const SightedCorner& corner, double share, const CornerCapture& capture);

}  // namespace quadloop
