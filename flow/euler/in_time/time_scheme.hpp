#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::flow::euler {

inline bool is_finite(const State& state) {
  return std::ranges::all_of(state, [](double value) { return std::isfinite(value); });
}

/// Whether the state is physical: finite, with positive density and pressure.
inline bool is_gas(const State& state) { return is_finite(state) && state[0] > 0 && state[3] > 0; }

/// A scheme with one global time step.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;

  /// Returns the longest possible next step. *Collective.*
  virtual double longest_step() = 0;

  /// `fluxes` are those of the states; the residual is evaluated at other states. Returns whether the flow
  /// can continue; if not, the states are those of the first failure. *Collective.*
  virtual bool advance(double step, const IdVector<NodeId, Flux>& fluxes) = 0;

  virtual bool is_implicit() const = 0;
  /// For implicit schemes: number of steps that were not solved to the tolerance.
  virtual int unsolved() const { return 0; }
};

/// Returns an implicit scheme with this step, or an explicit one with this CFL number. *Collective.*
std::unique_ptr<TimeScheme> time_scheme(FlowRun& run, std::optional<double> step, double cfl);

}  // namespace quadloop::flow::euler
