#pragma once

#include "flow/adjoint/linear_residual.hpp"

namespace quadloop::flow::euler {

/// Parameters of the linear solver.
struct AdjointSolve {
  double tolerance = 1e-10;  ///< on the residual, relative to the functional's derivative
  int iterations = 2000;     ///< maximum number
};
struct Adjoint {
  IdVector<NodeId, Flux> weights;  ///< of each node's net fluxes, including ghosts
  int iterations = 0;
  double residual = 1;  ///< relative to the functional's derivative, in conserved variables
  bool converged = false;
};

/// Solves (dR/dU)^T psi = dJ/dU; psi is the sensitivity of the functional J to net fluxes R added at each
/// node. Uses GMRES (Saad and Schultz 1986; flexible, Saad 1993), preconditioned by sweeps over the
/// transposed matrix of first-order fluxes. Bitwise independent of the number of ranks. *Collective.*
Adjoint solve_adjoint(const LinearResidual& linear, const IdVector<NodeId, State>& of_goal,
                      const AdjointSolve& how = {});

}  // namespace quadloop::flow::euler
