#pragma once

#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/krylov.hpp"
#include "flow/euler/scheme/residual.hpp"

namespace quadloop::flow::euler {

/// The linear system of a Newton step: (area / time step + derivative of the second-order residual) change =
/// right side. It is matrix-free: GMRES takes directional derivatives from differences of two residuals. The
/// preconditioner is an ImplicitSystem of first-order fluxes, which also provides the time steps.
class NewtonSystem {
 public:
  /// All arguments must outlive the object.
  NewtonSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model, Residual& residual,
               ImplicitSystem& system);

  struct Effort {
    double tolerance;  ///< relative to the norm of the right side
    int directions;    ///< maximum number of GMRES directions, 64 bytes per node each
    int sweeps;        ///< of the preconditioner
  };
  /// `fluxes` are those of the states; the residual is evaluated at other states. Returns the remaining
  /// residual relative to the right side. *Collective.*
  double solve(const IdVector<NodeId, State>& states, const NodeRows& fluxes, const NodeRows& right,
               const Effort& effort, NodeRows& change);

  /// Returns the root of the sum of squares over the owned nodes. *Collective.*
  double norm(const NodeRows& rows) const;

 private:
  void differentiate(const NodeRows& change, NodeRows& result);

  const Communicator& comm_;
  const DualMesh& mesh_;
  const FlowModel& model_;
  Residual& residual_;
  ImplicitSystem& system_;
  const IdVector<NodeId, State>* states_ = nullptr;  ///< of the current solve
  const NodeRows* fluxes_ = nullptr;
  IdVector<NodeId, Flux> right_;             ///< of the preconditioner, for each node
  IdVector<NodeId, Change> preconditioned_;  ///< for each node
  IdVector<NodeId, State> moved_;
};

}  // namespace quadloop::flow::euler
