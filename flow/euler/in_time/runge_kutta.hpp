#pragma once

#include "flow/euler/in_time/time_scheme.hpp"

namespace quadloop::flow::euler {

/// Explicit steps of order 3, strong stability preserving (Shu and Osher 1988). A step that makes density or
/// pressure negative at a node, e.g. in a starting expansion around a corner, is halved, repeatedly if
/// necessary.
class RungeKutta : public TimeScheme {
 public:
  /// `cfl` is limited to 0.8.
  RungeKutta(FlowRun& run, double cfl);

  double longest_step() override;
  bool advance(double step, const IdVector<NodeId, Flux>& fluxes) override;
  bool is_implicit() const override { return false; }

 private:
  bool take(double step, const IdVector<NodeId, Flux>& fluxes, int halvings);
  /// *Collective.*
  bool is_everywhere(bool (*holds)(const State&)) const;

  FlowRun& run_;
  double cfl_;
  IdVector<NodeId, double> wave_sums_;
  IdVector<NodeId, Conserved> start_;
};

}  // namespace quadloop::flow::euler
