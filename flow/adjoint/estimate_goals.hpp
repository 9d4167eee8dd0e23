#pragma once

#include "flow/euler/solve_euler.hpp"

namespace quadloop::flow {

/// Returns a callback for solve_euler() that estimates the errors of the options' output functionals for
/// adaptation: for each an adjoint solution and an error estimate (GoalValue). error_name is added to the
/// flow's variables, and with `adjoint_fields` the adjoints are. Empty without functionals. At the end of the
/// run throws InputError for a functional that mesh or flow do not have, and for a viscous or unsteady flow.
AtEnd estimate_goals(const EulerOptions& options);

}  // namespace quadloop::flow
