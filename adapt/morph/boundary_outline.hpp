#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The boundary of a mesh as an outline, the same on every rank: vertex v is a node, segment v the boundary
/// edge that leaves it.
struct BoundaryOutline {
  Geometry geometry;
  std::vector<GlobalNodeId>
      nodes;  ///< of each vertex; one where the boundary comes back to stands there twice
};

/// `mesh` has a closed boundary (MeshRule::closed). Each rank holds all boundary edges. *Collective.*
BoundaryOutline outline_of(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
