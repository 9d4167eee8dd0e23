#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The boundary of a mesh as a geometry, the same on every rank: vertex v is a node, segment v the boundary
/// edge that starts there.
struct BoundaryOutline {
  Geometry geometry;
  /// Node of each vertex; a node where the boundary passes twice is listed twice.
  std::vector<GlobalNodeId> nodes;
};

/// `mesh` must have a closed boundary (MeshRule::closed). Each rank stores all boundary edges. *Collective.*
BoundaryOutline outline_of(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop::adapt
