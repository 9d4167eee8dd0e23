#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "flow/euler/model/gas.hpp"

namespace quadloop::flow::euler {

/// Returns the flux through a face of length 1 with this unit normal.
template <class Real = double, class Vector = Point>
FluxOf<Real> physical_flux(const Gas& gas, const StateOf<Real>& state, const Vector& normal) {
  const auto& [rho, u, v, p] = state;
  const Real through = u * normal.x + v * normal.y, mass = rho * through;
  return {mass, mass * u + p * normal.x, mass * v + p * normal.y, mass * gas.total_enthalpy(state)};
}

/// Returns the change of the physical flux, for a normal of any length, due to a small change of the state:
/// its derivative.
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

/// Absolute values of the three wave speeds through a face, bounded away from zero.
template <class Real>
struct WaveSpeedsOf {
  Real fast, slow, middle;  ///< |q + c|, |q - c|, |q|, with q the normal velocity
};
using WaveSpeeds = WaveSpeedsOf<double>;

/// Entropy fix after Harten (1983): a speed below delta becomes (speed^2 + delta^2) / (2 delta). For acoustic
/// waves delta is 0.2 (|q| + c), which prevents expansion shocks at a sonic line. For the entropy and shear
/// wave it is 0.02 (|q| + c): enough to damp the odd-even decoupling of grid-aligned shocks, with little
/// dissipation of slow flow near a stagnation point. Near a strong shock it is at least `shock_share` times
/// the speed of sound (ShockSensor).
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

/// The average of two states that linearises the jump between them (Roe 1981).
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

///|A| dW, where A is the flux Jacobian along a normal at an intermediate state: middle dW + first [1, u, v,
/// H] + second [0, nx, ny, q]. This form needs no eigenvectors. `pressure` is the change of pressure,
///`momentum` density times the change of q.
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

/// Fraction of the jump of normal velocity across a face that the acoustic waves damp. Full damping is right
/// at sonic speed and, in slower flow, too large by the ratio of speed of sound to speed (Rieper 2011): the
/// fraction is then the Mach number, but not much less than that of the free stream, nor than `jump`, the
/// relative change of pressure: a shock, or a vacuum into gas at rest, needs full damping. The blending is
/// smooth, as the limits cross everywhere in the far field and derivatives are taken.
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

/// Returns the Roe flux (1981) through a face of length 1 with this unit normal, which points from `left` to
/// `right`; in slow flow with reduced damping, after Rieper (2011). The flux of two equal states is the
/// physical one up to rounding. `shock_share` is that of the edge by ShockSensor.
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

}  // namespace quadloop::flow::euler
