#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "flow/euler/model/gas.hpp"

namespace quadloop::euler {

/// What crosses a face of length 1 with this unit normal.
template <class Real = double, class Vector = Point>
FluxOf<Real> physical_flux(const Gas& gas, const StateOf<Real>& state, const Vector& normal) {
  const auto& [rho, u, v, p] = state;
  const Real through = u * normal.x + v * normal.y, mass = rho * through;
  return {mass, mass * u + p * normal.x, mass * v + p * normal.y, mass * gas.total_enthalpy(state)};
}

/// How the physical flux through a normal of any length answers to a small change of the state: its
/// derivative.
template <class Real = double, class Vector = Point>
FluxOf<Real> flux_change(const Gas& gas, const StateOf<Real>& state, const StateOf<Real>& change,
                         const Vector& normal) {
  const auto& [rho, u, v, p] = state;
  const auto& [d_rho, d_u, d_v, d_p] = change;
  const Real through = u * normal.x + v * normal.y, mass = rho * through;
  const Real d_mass = d_rho * through + rho * (d_u * normal.x + d_v * normal.y);
  const Real d_enthalpy = gas.gamma / (gas.gamma - 1) * (d_p - p * d_rho / rho) / rho + u * d_u + v * d_v;
  return {d_mass, d_mass * u + mass * d_u + d_p * normal.x, d_mass * v + mass * d_v + d_p * normal.y,
          d_mass * gas.total_enthalpy(state) + mass * d_enthalpy};
}

/// Sizes of the three wave speeds through a face, kept away from zero.
template <class Real>
struct WaveSpeedsOf {
  Real fast, slow, middle;  ///< |q + c|, |q - c|, |q|, with q the speed along the normal
};
using WaveSpeeds = WaveSpeedsOf<double>;

/// An entropy fix after Harten (1983): a speed below delta becomes (speed^2 + delta^2) / (2 delta). For the
/// sound waves delta is a fifth of |q| + c, so that no expansion shock stands at a sonic line. For the middle
/// wave, which carries entropy and shear, it is a fiftieth: enough to damp the odd-even decay of grid-aligned
/// shocks, and little dissipation of the slow flow near a stagnation point. Beside a strong shock it is that
/// share of the speed of sound at least (ShockSensor).
template <class Real = double>
WaveSpeedsOf<Real> wave_speeds(const std::type_identity_t<Real>& along,
                               const std::type_identity_t<Real>& sound,
                               const std::type_identity_t<Real>& shock_share = 0) {
  using std::abs;
  const Real largest = abs(along) + sound;
  const auto kept = [](const Real& signed_speed, const Real& delta) {
    const Real speed = abs(signed_speed);
    return speed < delta ? (speed * speed + delta * delta) / (2 * delta) : speed;
  };
  return {kept(along + sound, 0.2 * largest), kept(along - sound, 0.2 * largest),
          std::max<Real>(kept(along, 0.02 * largest), shock_share * sound)};
}

/// The state between two states that linearises the jump from one to the other (Roe 1981).
template <class Real>
struct RoeAverageOf {
  Real density, x_velocity, y_velocity, enthalpy, sound;
};
using RoeAverage = RoeAverageOf<double>;

template <class Real = double>
RoeAverageOf<Real> roe_average(const Gas& gas, const StateOf<Real>& left, const StateOf<Real>& right) {
  using std::sqrt;
  const Real root_left = sqrt(left[0]), root_right = sqrt(right[0]),
             share = root_right / (root_left + root_right);
  const auto between = [share](const Real& l, const Real& r) { return l + share * (r - l); };
  const Real u = between(left[1], right[1]), v = between(left[2], right[2]);
  const Real enthalpy = between(gas.total_enthalpy(left), gas.total_enthalpy(right));
  const Real sound_squared = (gas.gamma - 1) * (enthalpy - 0.5 * (u * u + v * v));
  return {root_left * root_right, u, v, enthalpy, sqrt(sound_squared)};
}

/// |A| dW for the matrix A of the flux along a normal, at a state between, with its wave speeds made
/// positive: middle dW + first [1, u, v, H] + second [0, nx, ny, q]. That form needs no eigenvectors.
/// `pressure` is the change of pressure, `momentum` density times that of q.
template <class Real>
struct UpwindPartOf {
  Real first, second;
};
using UpwindPart = UpwindPartOf<double>;

template <class Real = double>
UpwindPartOf<Real> upwind_part(const WaveSpeedsOf<Real>& waves, const std::type_identity_t<Real>& sound,
                               const std::type_identity_t<Real>& pressure,
                               const std::type_identity_t<Real>& momentum) {
  const Real even = 0.5 * (waves.fast + waves.slow) - waves.middle, odd = 0.5 * (waves.fast - waves.slow);
  return {even * pressure / (sound * sound) + odd * momentum / sound,
          even * momentum + odd * pressure / sound};
}

/// The share of the jump of speed across a face that waves of sound are to damp. In full it is as large as
/// the flow's own speed allows where that is the speed of sound, and too large by their ratio where the flow
/// is slower (Rieper 2011): there it is the Mach number, but not much below the free stream's, nor below
/// `jump`, the change of pressure as a share of it: a shock or a vacuum into gas at rest needs all of it.
/// Smooth where one passes the other, as they do all over the far field: derivatives are taken of it.
template <class Real>
Real slow_share(const Gas& gas, const RoeAverageOf<Real>& mean, const Real& jump) {
  using std::sqrt;
  if (gas.least_mach >= 1) return 1;
  const Real mach_squared =
      (mean.x_velocity * mean.x_velocity + mean.y_velocity * mean.y_velocity) / (mean.sound * mean.sound);
  const Real fourth = mach_squared * mach_squared + jump * jump * (jump * jump);
  if (fourth >= 1) return 1;
  const double least = gas.least_mach * gas.least_mach * (gas.least_mach * gas.least_mach);
  return sqrt(sqrt(least + (1 - least) * fourth));
}

/// What crosses a face of length 1 with this unit normal, which points from `left` to `right` (Roe 1981), in
/// slow flow much as Rieper (2011) has it. The flux of two equal states is the physical one but for rounding.
/// `shock_share` is the edge's by ShockSensor.
template <class Real = double, class Vector = Point>
FluxOf<Real> roe_flux(const Gas& gas, const StateOf<Real>& left, const StateOf<Real>& right,
                      const Vector& normal, const std::type_identity_t<Real>& shock_share = 0) {
  const FluxOf<Real> of_left = physical_flux(gas, left, normal), of_right = physical_flux(gas, right, normal);
  const RoeAverageOf<Real> mean = roe_average(gas, left, right);
  const Real along = mean.x_velocity * normal.x + mean.y_velocity * normal.y;
  const WaveSpeedsOf<Real> waves = wave_speeds<Real>(along, mean.sound, shock_share);
  const Real d_pressure = right[3] - left[3];
  const Real d_along = (right[1] - left[1]) * normal.x + (right[2] - left[2]) * normal.y;
  const Real share = slow_share(gas, mean, Real(2 * d_pressure / (left[3] + right[3])));
  const UpwindPartOf<Real> part = upwind_part(waves, mean.sound, d_pressure, share * mean.density * d_along);
  const ConservedOf<Real> l = gas.conserved(left), r = gas.conserved(right);
  const auto average = [](const Real& a, const Real& b, const Real& dissipation) {
    return 0.5 * (a + b - dissipation);
  };
  return {average(of_left[0], of_right[0], waves.middle * (r.mass - l.mass) + part.first),
          average(of_left[1], of_right[1],
                  waves.middle * (r.x_momentum - l.x_momentum) + part.first * mean.x_velocity +
                      part.second * normal.x),
          average(of_left[2], of_right[2],
                  waves.middle * (r.y_momentum - l.y_momentum) + part.first * mean.y_velocity +
                      part.second * normal.y),
          average(of_left[3], of_right[3],
                  waves.middle * (r.energy - l.energy) + part.first * mean.enthalpy + part.second * along)};
}

}  // namespace quadloop::euler
