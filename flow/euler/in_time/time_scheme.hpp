#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::euler {

inline bool is_finite(const State& state) {
  return std::ranges::all_of(state, [](double value) { return std::isfinite(value); });
}

/// Whether it is a state of a gas: all is finite, density and pressure are above 0.
inline bool is_gas(const State& state) { return is_finite(state) && state[0] > 0 && state[3] > 0; }

/// A way of taking steps that are the same size at all nodes.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;

  /// How long the next step may be. *Collective.*
  virtual double longest_step() = 0;

  /// `fluxes` are those of the states; the residual is evaluated at others. Tells whether the flow
  /// can go on from there; else the states are those in which it first failed. *Collective.*
  virtual bool advance(double step, const std::vector<Flux>& fluxes) = 0;

  virtual bool is_implicit() const = 0;
  /// Of an implicit scheme: steps whose equations were not solved to its tolerance.
  virtual int unsolved() const { return 0; }
};

/// Implicit steps of this size, or explicit ones of this CFL number. *Collective.*
std::unique_ptr<TimeScheme> time_scheme(FlowRun& run, std::optional<double> step, double cfl);

}  // namespace quadloop::euler
