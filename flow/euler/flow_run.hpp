#pragma once

#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "flow/euler/solve_euler.hpp"

namespace quadloop::euler {

/// What both ways of marching work on.
struct FlowRun {
  const Communicator& comm;
  const EulerOptions& options;
  const DualMesh& mesh;
  const FlowModel& model;
  Residual& residual;
  std::vector<State>& states;  ///< of each node
  bool is_carried = false;     ///< the states are those of a flow that was given
};

/// Root mean square of the owned nodes' net mass fluxes; not a number where any is not finite. *Collective.*
double mass_residual(const FlowRun& run, const std::vector<Flux>& fluxes);

/// Gives the far field the vortex of the lift that the states have, where the options ask for it.
/// *Collective.*
void surround(const FlowRun& run, FarField& far_field);

/// Keeps the history, and hands the options' callback what it is due. *Collective.*
void report(const FlowRun& run, EulerResult& result, double cfl, bool at_end);

/// "density ... at (x, y)" of the node, over all ranks, where the flow is least physical: the first that is
/// not, else that of the largest flux. *Collective.*
std::string worst_place(const FlowRun& run, const std::vector<Flux>& fluxes);

/// Implicit steps with local time steps until the tolerance is met or the iterations are used up.
/// *Collective.*
EulerResult march_to_steady(const FlowRun& run);

/// Explicit steps of one size to the end time. *Collective.*
EulerResult march_in_time(const FlowRun& run);

}  // namespace quadloop::euler
