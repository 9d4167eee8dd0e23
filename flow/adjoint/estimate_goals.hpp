#pragma once

#include "flow/euler/solve_euler.hpp"

namespace quadloop {

/// What a flow's error is as an adaptation takes it, to be handed to solve_euler(): for each of the options'
/// goals an adjoint solution and the estimate of its error (GoalValue); error_name joins the flow's
/// variables, and with `adjoint_fields` the adjoints do. Nothing where there are no goals. Throws InputError,
/// when the flow ends, for a goal that the mesh or the flow does not have, and for a flow that is viscous or
/// not steady.
AtEnd estimate_goals(const EulerOptions& options);

}  // namespace quadloop
