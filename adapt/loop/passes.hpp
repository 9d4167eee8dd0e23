#pragma once

#include "adapt/loop/loop.hpp"

namespace quadloop {

/// The first mesh that is solved to the end, found in adapt.passes adaptations before it by flows that are
/// solved roughly: shocks and edges are where they will be long before forces stand still. Fewer passes where
/// one asks for no other mesh. What they warn of joins the warnings of the mesh's report. *Collective.*
CarriedMesh mesh_after_passes(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                              const FlowSolver& rough_solver);

}  // namespace quadloop
