#pragma once

#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/postprocess/boundary_forces.hpp"

namespace quadloop::flow::euler {

/// Lift and drag per unit depth, divided by dynamic pressure and reference length.
struct ForceCoefficients {
  double cl = 0, cd = 0;                    ///< pressure and friction
  double cl_friction = 0, cd_friction = 0;  ///< friction only
};

/// Returns the force of the pressure, minus the free-stream pressure, and of friction on all boundaries that
/// feels_force() selects; 0 if the free stream is at rest. The states of ghosts must be up to date;
/// `friction` is as Residual::friction(). *Collective.*
ForceCoefficients wall_forces(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                              const IdVector<NodeId, State>& states, const IdVector<NodeId, Point>& friction,
                              double reference_length);

/// Returns the same for each of these boundaries that has edges, in the mesh's order. The friction of a node
/// where boundaries meet is split by the lengths of their edges. *Collective.*
std::vector<BoundaryForce> forces_of_boundaries(const Communicator& comm, const DualMesh& mesh,
                                                const FlowModel& model, const IdVector<NodeId, State>& states,
                                                const IdVector<NodeId, Point>& friction,
                                                double reference_length,
                                                const std::vector<BoundaryEdges>& boundaries);

/// Returns the friction along the wall at each owned node (wall_shear_name).
IdVector<NodeId, double> wall_shear(const DualMesh& mesh, const FlowModel& model,
                                    const IdVector<NodeId, Point>& friction);

}  // namespace quadloop::flow::euler
