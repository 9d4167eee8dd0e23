#pragma once

#include "adapt/loop/loop.hpp"

namespace quadloop::adapt {

/// Returns the mesh of cycle 0, after adapt.passes initial adaptations with loosely converged solutions:
/// shocks and edges reach their positions long before forces converge. Stops early if a pass does not change
/// the mesh. Warnings are added to those of the mesh's report. *Collective.*
RemeshedSolution mesh_after_passes(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                                   const flow::FlowSolver& rough_solver);

}  // namespace quadloop::adapt
