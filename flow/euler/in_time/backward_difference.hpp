#pragma once

#include <array>
#include <vector>

#include "flow/euler/implicit/newton_system.hpp"
#include "flow/euler/in_time/time_scheme.hpp"

namespace quadloop::euler {

/// Implicit steps of order 2: the backward difference over this step and the one before (BDF2, with the
/// coefficients of unequal steps), the first of order 1. It damps what is faster than the steps. Each step is
/// solved by Newton's method, from the flow that goes on as in the step before. A step that cannot be solved,
/// as beside strong shocks that move over several cells, is taken in halves.
class BackwardDifference : public TimeScheme {
 public:
  BackwardDifference(FlowRun& run, double step);

  double longest_step() override { return step_; }
  bool advance(double step, const std::vector<Flux>& fluxes) override;
  bool is_implicit() const override { return true; }
  int unsolved() const override { return unsolved_; }

 private:
  /// now * (next state) + known = area / step * (difference in time).
  struct Weights {
    double next, last, before;
  };
  using Row = std::array<double, 4>;

  static Weights weights(double ratio);
  bool take(double step, const NodeRows& fluxes, int halvings);
  bool solve(double step, const NodeRows& fluxes);
  void remember();
  void find_known(const Weights& weights, double step);
  double measure(const std::vector<Flux>& fluxes, double rate);
  double go_on(double ratio, double rate, double size);
  double newton(double rate, double size, double enough);

  FlowRun& run_;
  double step_, last_step_ = 0;  ///< wanted; of the step before, 0 where there is none
  ImplicitSystem system_;
  NewtonSystem newton_;
  std::vector<char> held_;     ///< as NoSlipNodes::held_rows
  NodeRows last_, before_;     ///< what is conserved at the owned nodes, at the step's start and one earlier
  NodeRows known_;             ///< of the difference in time: area / step times what is known
  NodeRows fluxes_, balance_;  ///< of the last measured states: net fluxes; these and the difference in time
  NodeRows change_;
  std::vector<State> start_;
  int unsolved_ = 0;
};

}  // namespace quadloop::euler
