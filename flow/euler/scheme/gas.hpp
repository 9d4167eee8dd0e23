#pragma once

#include <array>
#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop::euler {

/// Density, x velocity, y velocity, pressure, in units of the free stream's density and speed of sound.
using State = std::array<double, 4>;

/// What crosses a face per time: mass, x momentum, y momentum, energy.
using Flux = std::array<double, 4>;

/// What is conserved, per area: mass, x momentum, y momentum, energy.
struct Conserved {
  double mass, x_momentum, y_momentum, energy;
};

/// A perfect gas.
struct Gas {
  double gamma = 1.4;  ///< ratio of specific heats

  double sound_speed(const State& state) const { return std::sqrt(gamma * state[3] / state[0]); }

  /// Per mass.
  double total_enthalpy(const State& state) const {
    return gamma / (gamma - 1) * state[3] / state[0] + 0.5 * (state[1] * state[1] + state[2] * state[2]);
  }
  Conserved conserved(const State& state) const {
    const auto& [rho, u, v, p] = state;
    return {rho, rho * u, rho * v, p / (gamma - 1) + 0.5 * rho * (u * u + v * v)};
  }
  State state(const Conserved& w) const {
    const double u = w.x_momentum / w.mass, v = w.y_momentum / w.mass;
    return {w.mass, u, v, (gamma - 1) * (w.energy - 0.5 * (w.x_momentum * u + w.y_momentum * v))};
  }

  /// The flow of density 1 and speed of sound 1 that moves at this Mach number, `degrees` above the x axis.
  State free_stream(double mach, double degrees) const;
};

}  // namespace quadloop::euler
