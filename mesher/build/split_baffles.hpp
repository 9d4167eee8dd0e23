#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Gives each side of a baffle nodes of its own: a node with cells in several sectors between edges of
/// baffles becomes one node for each of them. The nodes at free ends of baffles stay single. Afterwards the
/// sides are ordinary boundaries of the mesh. *Collective.*
void split_baffles(const Communicator& comm, const Geometry& geometry, Mesh& mesh);

}  // namespace quadloop
