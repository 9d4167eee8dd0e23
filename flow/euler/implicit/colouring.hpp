#pragma once

#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/mesh/colouring.hpp"

namespace quadloop::euler {

/// Colours for all nodes, so that no edge joins two of one colour: a relaxation may visit the nodes of a
/// colour at once. *Collective.*
Colouring colour_dual_nodes(const Communicator& comm, const DualMesh& mesh);

}  // namespace quadloop::euler
