#pragma once

#include "flow/adjoint/goal_functional.hpp"

namespace quadloop::flow::euler {

/// Discretisation error of an output functional.
struct GoalError {
  double signed_sum = 0;              ///< subtracting this from the functional gives a better value
  double sum = 0;                     ///< sum of the absolute nodal contributions, without cancellation
  IdVector<NodeId, double> of_nodes;  ///< absolute contributions of the owned nodes
};

/// Returns the dual-weighted residual: the flow's residual with higher-order fluxes, weighted by the adjoint
/// (Giles and Pierce, Acta Numerica 2002; Fidkowski and Darmofal, AIAA J. 49, 2011), in each cell and on each
/// wall.
///
/// The net fluxes of median-dual cells are those of linear finite elements (Barth 1991), so psi . residual is
/// a sum over cells T and their edges of (psi_b - psi_a) . flux through the edge's face in T. The difference
/// between this and the integral of grad psi . F over T, with F of a higher-order flow, is the contribution
/// of the cell. It is of order h^2 times its area and is distributed among its nodes. The higher-order flow
/// is cubic along edges, from unlimited gradients; psi is linear in triangles, bilinear in quads. `states`
/// and `adjoint` must include ghosts. Errors from chords of a curved boundary and from the far-field distance
/// are not included. *Collective.*
GoalError goal_error(const FlowRun& run, const GoalFunctional& goal, const IdVector<NodeId, Flux>& adjoint);

}  // namespace quadloop::flow::euler
