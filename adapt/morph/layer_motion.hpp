#pragma once

#include <optional>

#include "adapt/morph/boundary_motion.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

using NodeMotions = IdVector<NodeId, std::optional<RigidMotion>>;

/// Each column of layers moves as its foot on the wall does: heights and angles in it stay. `motions` has
/// those of boundary nodes, for each node of the halo mesh, and gets those of the other nodes in layers on
/// walls; nodes of strips get none. *Collective.*
void move_columns(const Communicator& comm, const HaloMesh& mesh, const LayerPlaces& places,
                  NodeMotions& motions);

}  // namespace quadloop
