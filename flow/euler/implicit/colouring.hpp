#pragma once

#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/mesh/colouring.hpp"

namespace quadloop::flow::euler {

/// Colours all nodes such that no edge connects two of one colour: a relaxation may update the nodes of a
/// colour concurrently. *Collective.*
Colouring colour_dual_nodes(const Communicator& comm, const DualMesh& mesh);

}  // namespace quadloop::flow::euler
