#pragma once

#include <cstdint>

#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

/// Of each node the number of the boundary node with which it moves as one piece; below 0: none.
using NodeFeet = IdVector<NodeId, std::int32_t>;

/// Each column of layers moves as its foot on the wall does: heights and angles in it stay. `feet` has those
/// of boundary nodes, which are their own, for each node of the halo mesh, and gets those of the other nodes
/// in layers on walls; nodes of strips get none. *Collective.*
void find_feet(const Communicator& comm, const HaloMesh& mesh, const LayerPlaces& places, NodeFeet& feet);

}  // namespace quadloop
