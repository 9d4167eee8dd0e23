#pragma once

#include "flow/flow_solver.hpp"

namespace quadloop {

/// A solver with what quadloop makes of its flow itself, whichever solver it is: the free stream, the flow at
/// walls (wall_flow()), the forces on each, and cl and cd, their sums, where the solver does not tell them.
/// A flow without velocity and pressure gets none of these, and a warning.
FlowSolver with_wall_quantities(FlowSolver solver, FreeStream stream);

}  // namespace quadloop
