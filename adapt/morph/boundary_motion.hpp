#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapt/morph/boundary_outline.hpp"
#include "adapt/morph/outline_map.hpp"

namespace quadloop::adapt {

/// A rotation about one point followed by a translation of that point to another.
struct RigidMotion {
  Point from, to;
  double angle = 0;  ///< radians, counter-clockwise

  Point moved(Point p) const;
  /// Returns the motion scaled by `share`: 0 none, 1 all of it.
  RigidMotion part(double share) const { return {from, from + share * (to - from), share * angle}; }
};

/// The motion of a boundary node, with half the lengths of its two edges before the motion.
struct BoundaryNodeMotion {
  GlobalNodeId node;
  RigidMotion motion;
  double width = 0;
  std::int32_t vertex = -1;  ///< of the mesh boundary
};

/// The change of geometry of a mesh.
struct OutlineChange {
  const Geometry& to;
  std::string file;  ///< file of `to`, for messages
  /// The geometry of the mesh, if known: if `to` has the same number of points, nodes stay on their segment.
  /// Otherwise nodes keep their relative position between two corners.
  const Geometry* from = nullptr;
  std::string from_file = {};
  /// Whether `from` and `to` are OutlinePieces: edges between two blocks and of inner lines then move with
  /// their pieces. Otherwise inner lines follow the boundary.
  bool by_pieces = false;
};

/// Returns the motions of all boundary nodes, sorted by number, each once; nodes of boundaries that the new
/// geometry lacks do not move. A node rotates by the mean of its two edges' rotations. Throws InputError as
/// OutlineMap does, if a node is not on `change.from`, and if the pieces that meet at a node separate.
std::vector<BoundaryNodeMotion> boundary_motion(const BoundaryOutline& outline, const OutlineChange& change);

/// Returns the image of each vertex of a mesh boundary.
std::vector<Point> images_of(const BoundaryOutline& outline, const OutlineChange& change);

/// Returns the image of each vertex of a mesh boundary as a weighted mean of points of `change.to`. Throws
/// InputError as boundary_motion() does, and if the points of a loop do not correspond one-to-one to those of
/// `change.from`.
std::vector<PointShares> image_shares(const BoundaryOutline& outline, const OutlineChange& change);

}  // namespace quadloop::adapt
