#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapt/morph/boundary_outline.hpp"
#include "adapt/morph/outline_map.hpp"

namespace quadloop {

/// A turn about one point and a shift of that to another.
struct RigidMotion {
  Point from, to;
  double angle = 0;  ///< radians, counter-clockwise

  Point moved(Point p) const;
  /// The same way gone in part: 0 not at all, 1 whole.
  RigidMotion part(double share) const { return {from, from + share * (to - from), share * angle}; }
};

/// What a boundary node does, with half the lengths of its two edges before it does so.
struct BoundaryNodeMotion {
  GlobalNodeId node;
  RigidMotion motion;
  double width = 0;
  std::int32_t vertex = -1;  ///< of the mesh's outline
};

/// Where a mesh's outline is to go.
struct OutlineChange {
  const Geometry& to;
  std::string file;  ///< its, for messages
  /// The outline that the mesh was made on, if it is known: where `to` has as many points, nodes stay with
  /// their segment. Else they keep their share of the way between two corners.
  const Geometry* from = nullptr;
  std::string from_file = {};
};

/// Of all boundary nodes, by their numbers, each once; those of boundaries that the new outline lacks stay. A
/// node turns by the mean of what its two edges do. Throws InputError as OutlineMap does, and where a node is
/// not on `change.from`.
std::vector<BoundaryNodeMotion> boundary_motion(const BoundaryOutline& outline, const OutlineChange& change);

/// Where each vertex of a mesh's outline goes.
std::vector<Point> images_of(const BoundaryOutline& outline, const OutlineChange& change);

/// Of which points of `change.to` the image of each vertex of a mesh's outline is a mean. Throws InputError
/// as boundary_motion(), and where a loop's points do not stand for those of `change.from`, one for one.
std::vector<PointShares> image_shares(const BoundaryOutline& outline, const OutlineChange& change);

}  // namespace quadloop
