#pragma once

#include <vector>

#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/krylov.hpp"
#include "flow/euler/scheme/residual.hpp"

namespace quadloop::euler {

/// The linear system of a Newton step: (area / time step + derivative of the second-order residual) change =
/// right side. GMRES needs no such matrix, as the derivative along a change is a difference of two residuals;
/// an ImplicitSystem of first-order fluxes, which has the time steps too, is its preconditioner.
class NewtonSystem {
 public:
  /// All must outlive it.
  NewtonSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model, Residual& residual,
               ImplicitSystem& system);

  struct Effort {
    double tolerance;  ///< of the right side's norm
    int directions;    ///< at most: of GMRES, 64 bytes each for a node
    int sweeps;        ///< of the preconditioner
  };
  /// `fluxes` are those of the states; the residual is evaluated at others meanwhile. Returns what is left,
  /// as a share of the right side. *Collective.*
  double solve(const std::vector<State>& states, const NodeRows& fluxes, const NodeRows& right,
               const Effort& effort, NodeRows& change);

  /// The root of the sum of squares of the owned nodes' values. *Collective.*
  double norm(const NodeRows& rows) const;

 private:
  void differentiate(const NodeRows& change, NodeRows& result);

  const Communicator& comm_;
  const DualMesh& mesh_;
  const FlowModel& model_;
  Residual& residual_;
  ImplicitSystem& system_;
  const std::vector<State>* states_ = nullptr;  ///< of the solve under way
  const NodeRows* fluxes_ = nullptr;
  std::vector<Flux> right_;             ///< of the preconditioner, for each node
  std::vector<Change> preconditioned_;  ///< for each node
  std::vector<State> moved_;
};

}  // namespace quadloop::euler
