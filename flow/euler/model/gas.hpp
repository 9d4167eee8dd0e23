#pragma once

#include <array>
#include <cmath>

#include "mesher/geometry/point.hpp"

namespace quadloop::flow::euler {

/// Density, x velocity, y velocity, pressure, in units of free-stream density and speed of sound.
using State = std::array<double, 4>;

/// Flux through a face per time: mass, x momentum, y momentum, energy.
using Flux = std::array<double, 4>;

/// States and fluxes of another number type: functions of them are templates, so that they can be
/// differentiated (dual_number.hpp).
template <class Real>
using StateOf = std::array<Real, 4>;
template <class Real>
using FluxOf = std::array<Real, 4>;

/// Conserved variables per area: mass, x momentum, y momentum, energy.
template <class Real>
struct ConservedOf {
  Real mass, x_momentum, y_momentum, energy;
};
using Conserved = ConservedOf<double>;

/// A perfect gas.
struct Gas {
  double gamma = 1.4;  ///< ratio of specific heats
  /// Lower limit of the Mach number in roe_flux(): that of a subsonic free stream. 1: no low-Mach correction.
  double least_mach = 1;

  template <class Real = double>
  Real sound_speed(const StateOf<Real>& state) const {
    using std::sqrt;
    return sqrt(gamma * state[3] / state[0]);
  }

  /// Per unit mass.
  template <class Real = double>
  Real total_enthalpy(const StateOf<Real>& state) const {
    return gamma / (gamma - 1) * state[3] / state[0] + 0.5 * (state[1] * state[1] + state[2] * state[2]);
  }
  template <class Real = double>
  ConservedOf<Real> conserved(const StateOf<Real>& state) const {
    const auto& [rho, u, v, p] = state;
    return {rho, rho * u, rho * v, p / (gamma - 1) + 0.5 * rho * (u * u + v * v)};
  }
  template <class Real = double>
  StateOf<Real> state(const ConservedOf<Real>& w) const {
    const Real u = w.x_momentum / w.mass, v = w.y_momentum / w.mass;
    return {w.mass, u, v, (gamma - 1) * (w.energy - 0.5 * (w.x_momentum * u + w.y_momentum * v))};
  }

  /// Returns the free stream with density 1 and speed of sound 1 at this Mach number, `degrees` above the x
  /// axis.
  State free_stream(double mach, double degrees) const;
};

}  // namespace quadloop::flow::euler
