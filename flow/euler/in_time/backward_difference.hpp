#pragma once

#include <array>

#include "flow/euler/implicit/newton_system.hpp"
#include "flow/euler/in_time/time_scheme.hpp"

namespace quadloop::flow::euler {

/// Implicit steps of order 2: BDF2 with the coefficients of variable steps; the first step is of order 1.
/// Damps motion faster than the steps. Each step is solved by Newton's method, starting from the extrapolated
/// states. A step that cannot be solved, e.g. near strong shocks that move over several cells, is halved.
class BackwardDifference : public TimeScheme {
 public:
  BackwardDifference(FlowRun& run, double step);

  double longest_step() override { return step_; }
  bool advance(double step, const IdVector<NodeId, Flux>& fluxes) override;
  bool is_implicit() const override { return true; }
  int unsolved() const override { return unsolved_; }

 private:
  /// now * (next state) + known = area / step * (time difference).
  struct Weights {
    double next, last, before;
  };
  using Row = std::array<double, 4>;

  static Weights weights(double ratio);
  NodeRows of_owned(const IdVector<NodeId, Flux>& fluxes) const;
  bool take(double step, const NodeRows& fluxes, int halvings);
  bool solve(double step, const NodeRows& fluxes);
  void remember();
  void find_known(const Weights& weights, double step);
  double measure(const IdVector<NodeId, Flux>& fluxes, double rate);
  double go_on(double ratio, double rate, double size);
  double newton(double rate, double size, double enough);

  FlowRun& run_;
  double step_, last_step_ = 0;  ///< requested step; previous step, 0 if there is none
  ImplicitSystem system_;
  NewtonSystem newton_;
  IdVector<NodeId, char> held_;  ///< as NoSlipNodes::held_rows
  /// Conserved variables at the owned nodes, at the start of the step and one step earlier.
  NodeRows last_, before_;
  NodeRows known_;  ///< known part of the time difference: area / step times earlier states
  /// At the last measured states: net fluxes; their sum with the time difference.
  NodeRows fluxes_, balance_;
  NodeRows change_;
  IdVector<NodeId, State> start_;
  int unsolved_ = 0;
};

}  // namespace quadloop::flow::euler
