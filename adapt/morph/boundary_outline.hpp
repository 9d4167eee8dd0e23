#pragma once

#include <set>
#include <string>
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

/// `mesh` must have a closed boundary (MeshRule::closed). Each rank stores all boundary edges. Inner lines
/// are left out. With `by_pieces` the inner lines in `names` are in it, too, and edges with cells on both
/// sides are walked in both directions. Throws InputError if the edges are no closed loops. *Collective.*
BoundaryOutline outline_of(const Communicator& comm, const Mesh& mesh, bool by_pieces = false,
                           const std::set<std::string>& names = {});

/// Whether the boundaries of a mesh are closed loops, with each edge between two blocks walked once, and it
/// has neither inner lines nor two boundary nodes at one place, as on the sides of a baffle. *Collective.*
bool has_closed_boundaries(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop::adapt
