#pragma once

#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/quantities/boundary_forces.hpp"

namespace quadloop::euler {

/// Force per depth over dynamic pressure and reference length, across and along the free stream.
struct ForceCoefficients {
  double cl = 0, cd = 0;                    ///< by pressure and friction
  double cl_friction = 0, cd_friction = 0;  ///< the part of friction
};

/// What the pressure, less the free stream's, and friction do to all boundaries that feels_force() counts; 0
/// where the free stream rests. The states' copies must be up to date; `friction` is as Residual::friction().
/// *Collective.*
ForceCoefficients wall_forces(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                              const std::vector<State>& states, const std::vector<Point>& friction,
                              double reference_length);

/// The same for each of these boundaries that has edges, in the mesh's order. Of a node's friction each
/// boundary that meets there has the share of its edges' lengths. *Collective.*
std::vector<BoundaryForce> forces_of_boundaries(const Communicator& comm, const DualMesh& mesh,
                                                const FlowModel& model, const std::vector<State>& states,
                                                const std::vector<Point>& friction, double reference_length,
                                                const std::vector<BoundaryEdges>& boundaries);

/// The friction along the wall at each owned node, as wall_shear_name says.
std::vector<double> wall_shear(const DualMesh& mesh, const FlowModel& model,
                               const std::vector<Point>& friction);

}  // namespace quadloop::euler
