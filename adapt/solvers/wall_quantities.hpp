#pragma once

#include "flow/flow_solver.hpp"

namespace quadloop::adapt {

/// Returns the solver extended by what quadloop computes itself for any solver: the free stream, the flow
/// along walls (wall_flow()), the force on each wall, and cl and cd, their sums, if the solver does not
/// provide them. A solution without velocity and pressure gets none of these, and a warning.
flow::FlowSolver with_wall_quantities(flow::FlowSolver solver, flow::FreeStream stream);

}  // namespace quadloop::adapt
