#pragma once

#include <vector>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/krylov.hpp"

namespace quadloop::euler {

/// A step of an inexact Newton method (Knoll and Keyes 2004): (area / time step + derivative of the
/// second-order residual) change = -residual by GMRES, which needs no such matrix, as the derivative along a
/// change is a difference of two residuals; the system of first-order fluxes is its preconditioner. The
/// change is halved until the residual falls.
class NewtonStep {
 public:
  /// Both must outlive it. *Collective.*
  NewtonStep(const FlowRun& run, ImplicitSystem& system);

  struct Taken {
    double share;      ///< of the change: the largest that made the residual smaller, 0 where none did
    double left_over;  ///< of the linear system's residual, as a share of its right side
  };
  /// The states become those after the step. `fluxes` are those of the states before; the residual is
  /// evaluated at others meanwhile. *Collective.*
  Taken take(const std::vector<Flux>& fluxes, double cfl, const std::vector<double>& shares);

 private:
  double solve();
  double norm(const std::vector<Flux>& fluxes) const;
  void differentiate(const NodeRows& change, NodeRows& result);
  double advance(double share);

  FlowRun run_;
  ImplicitSystem& system_;
  NodeRows residual_, change_;
  std::vector<Flux> right_;             ///< of the preconditioner, for each node
  std::vector<Change> preconditioned_;  ///< for each node
  std::vector<State> start_, moved_;
};

}  // namespace quadloop::euler
