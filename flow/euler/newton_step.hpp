#pragma once

#include "flow/euler/implicit/newton_system.hpp"
#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::flow::euler {

/// A step of an inexact Newton method (Knoll and Keyes 2004): a NewtonSystem with -residual as its right
/// side. The change is halved until the residual falls.
class NewtonStep {
 public:
  /// Run and system must outlive the object. *Collective.*
  NewtonStep(FlowRun& run, ImplicitSystem& system);

  struct Taken {
    double share;      ///< largest fraction of the change that reduced the residual, 0 if none did
    double left_over;  ///< residual of the linear system, relative to its right side
  };
  /// Updates the states. `fluxes` are those of the states before; the residual is evaluated at other states.
  /// *Collective.*
  Taken take(const IdVector<NodeId, Flux>& fluxes, double cfl, const IdVector<NodeId, double>& shares);

 private:
  double solve();
  double advance(double share);

  FlowRun& run_;
  ImplicitSystem& system_;
  NewtonSystem newton_;
  NodeRows residual_, change_;
  IdVector<NodeId, State> start_;
};

}  // namespace quadloop::flow::euler
