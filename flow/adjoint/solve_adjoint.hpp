#pragma once

#include <vector>

#include "flow/adjoint/linear_residual.hpp"

namespace quadloop::euler {

/// How a linear system is solved, and how well it was.
struct AdjointSolve {
  double tolerance = 1e-10;  ///< on what is left, relative to the goal's derivative
  int iterations = 2000;     ///< at most
};
struct Adjoint {
  std::vector<Flux> weights;  ///< of each node's net fluxes, with copies
  int iterations = 0;
  double residual = 1;  ///< what is left, relative to the goal's derivative, in conserved variables
  bool converged = false;
};

/// Solves (dR/dU)^T psi = dJ/dU for what a goal J answers to net fluxes R added at each node: by GMRES (Saad
/// and Schultz 1986; flexible, Saad 1993), preconditioned by sweeps over the transposed matrix of first-order
/// fluxes. The same bits on any number of ranks. *Collective.*
Adjoint solve_adjoint(const LinearResidual& linear, const std::vector<State>& of_goal,
                      const AdjointSolve& how = {});

}  // namespace quadloop::euler
