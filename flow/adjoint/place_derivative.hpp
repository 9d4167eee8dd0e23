#pragma once

#include <vector>

#include "flow/adjoint/goal_functional.hpp"
#include "flow/adjoint/linear_residual.hpp"

namespace quadloop::euler {

/// How a goal of the converged flow answers to the place of each owned node, every other node being held and
/// the flow solved anew: what the goal itself answers, less psi . (what the residual answers). With how
/// nodes follow a parameter of the outline it is the goal's derivative by that. Exact but where the scheme
/// gives less than all of what quads' faces lack (DualMesh, SkewEdge; boundary halves): that share, as in
/// stacks of thin cells, is held. `adjoint` must have copies. The same bits on any number of ranks.
/// *Collective.*
std::vector<Point> place_derivative(const LinearResidual& linear, const GoalFunctional& goal,
                                    const std::vector<Flux>& adjoint);

}  // namespace quadloop::euler
