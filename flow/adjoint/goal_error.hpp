#pragma once

#include <vector>

#include "flow/adjoint/goal_functional.hpp"

namespace quadloop::euler {

/// What the discretisation takes from or adds to a goal.
struct GoalError {
  double signed_sum = 0;         ///< the goal less this is a better value of it
  double sum = 0;                ///< of the sizes of what nodes add: no sign of one cancels another's
  std::vector<double> of_nodes;  ///< these sizes, of the owned nodes
};

/// The flow's residual by fluxes of a higher order, weighted by the adjoint (a dual-weighted residual: Giles
/// and Pierce, Acta Numerica 2002; Fidkowski and Darmofal, AIAA J. 49, 2011), in each cell and on each wall.
///
/// The net fluxes of median-dual cells are those of linear finite elements (Barth 1991), so that
/// psi . residual is a sum over cells T and their edges, of (psi_b - psi_a) . flux through the edge's face in
/// T: what this is less than the integral of grad psi . F over T, with F of a flow of higher order, is the
/// cell's part, of the order of h^2 times its area, and is shared out among its nodes. That flow is cubic
/// along edges, by gradients that are not limited; psi is linear in triangles, bilinear in quads. `states`
/// and `adjoint` must have copies. What an outline's chords cut off, and how far the far field is, do not
/// count. *Collective.*
GoalError goal_error(const FlowRun& run, const GoalFunctional& goal, const std::vector<Flux>& adjoint);

}  // namespace quadloop::euler
