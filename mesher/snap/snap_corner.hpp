#pragma once

#include <optional>
#include <span>

#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/snap/capture_points.hpp"
#include "mesher/snap/corner_sights.hpp"

namespace quadloop {

/// A lattice corner with what it sees of the outline.
struct SightedCorner {
  LatticePoint corner;
  Point position;   ///< where the lattice has it
  double edge = 0;  ///< the shortest leaf edge there
  std::span<const Sight> sights;
  /// If the mesh is to be its own mirror image: a corner on the axis moves along it alone, and of places
  /// equally near to a corner beside it the one is taken whose image the corner's image takes.
  std::optional<MirrorAxis> mirror = {};
};

/// Decides where a corner goes that has a crossing nearer than `share` of the shortest edge there, if it
/// does. What follows is a contraction: on each edge from the corner the crossings next to it are taken, of
/// one run of the outline, so the leaves around stay cut in the same pattern. A corner that takes two runs,
/// or would swallow a kept point, stays.
std::optional<Snap> snap_corner(const Geometry& geometry, const LeafTraces& traces,
                                const SightedCorner& corner, double share);

/// Moves a corner to the point that captures it, and takes that point's run along, as far as it can; where it
/// cannot and the corner has other crossings near, these decide.
std::optional<Snap> snap_captured(const Geometry& geometry, const LeafTraces& traces,
                                  const SightedCorner& corner, double share, const CornerCapture& capture);

}  // namespace quadloop
