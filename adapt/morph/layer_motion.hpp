#pragma once

#include <cstdint>

#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

/// For each node the number of the boundary node with which it moves rigidly; negative: none.
using NodeFeet = IdVector<NodeId, std::int32_t>;

/// Each column of layers moves with its foot on the wall: heights and angles in it do not change. On input
/// `feet` has the boundary nodes, which are their own feet, for each node of the halo mesh; adds those of the
/// other nodes in layers on walls. Nodes of strips get none. *Collective.*
void find_feet(const Communicator& comm, const HaloMesh& mesh, const LayerPlaces& places, NodeFeet& feet);

}  // namespace quadloop::adapt
