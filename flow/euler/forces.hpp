#pragma once

#include <vector>

#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/flow_model.hpp"

namespace quadloop::euler {

/// Force per depth over dynamic pressure and reference length, across and along the free stream.
struct ForceCoefficients {
  double cl = 0, cd = 0;
};

/// What the pressure, less the free stream's, does to all boundaries that feels_force() counts; 0 where the
/// free stream rests. The states' copies must be up to date. *Collective.*
ForceCoefficients wall_forces(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                              const std::vector<State>& states, double reference_length);

}  // namespace quadloop::euler
