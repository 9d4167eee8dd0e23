#pragma once

#include "flow/adjoint/goal_functional.hpp"
#include "flow/adjoint/linear_residual.hpp"

namespace quadloop::flow::euler {

/// Returns the total derivative of an output functional of the converged flow with respect to the position of
/// each owned node, with the other nodes fixed: the derivative of the functional minus psi . (derivative of
/// the residual). Multiplied by the derivative of the node positions with respect to a shape parameter it
/// gives the functional's derivative with respect to that parameter. Exact, except that the fractions by
/// which the skewness corrections of quads are reduced (DualMesh, SkewEdge; boundary halves), e.g. in stacks
/// of thin cells, are held constant. `adjoint` must include ghosts. Bitwise independent of the number of
/// ranks. *Collective.*
IdVector<NodeId, Point> place_derivative(const LinearResidual& linear, const GoalFunctional& goal,
                                         const IdVector<NodeId, Flux>& adjoint);

}  // namespace quadloop::flow::euler
