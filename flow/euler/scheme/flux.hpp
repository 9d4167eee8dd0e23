#pragma once

#include <algorithm>
#include <cmath>

#include "flow/euler/scheme/gas.hpp"

namespace quadloop::euler {

/// What crosses a face of length 1 with this unit normal.
inline Flux physical_flux(const Gas& gas, const State& state, Point normal) {
  const auto& [rho, u, v, p] = state;
  const double through = u * normal.x + v * normal.y, mass = rho * through;
  return {mass, mass * u + p * normal.x, mass * v + p * normal.y, mass * gas.total_enthalpy(state)};
}

/// How the physical flux through a normal of any length answers to a small change of the state: its
/// derivative.
inline Flux flux_change(const Gas& gas, const State& state, const State& change, Point normal) {
  const auto& [rho, u, v, p] = state;
  const auto& [d_rho, d_u, d_v, d_p] = change;
  const double through = u * normal.x + v * normal.y, mass = rho * through;
  const double d_mass = d_rho * through + rho * (d_u * normal.x + d_v * normal.y);
  const double d_enthalpy = gas.gamma / (gas.gamma - 1) * (d_p - p * d_rho / rho) / rho + u * d_u + v * d_v;
  return {d_mass, d_mass * u + mass * d_u + d_p * normal.x, d_mass * v + mass * d_v + d_p * normal.y,
          d_mass * gas.total_enthalpy(state) + mass * d_enthalpy};
}

/// Sizes of the three wave speeds through a face, kept away from zero.
struct WaveSpeeds {
  double fast, slow, middle;  ///< |q + c|, |q - c|, |q|, with q the speed along the normal
};

/// An entropy fix after Harten (1983): a speed below delta becomes (speed^2 + delta^2) / (2 delta). For the
/// sound waves delta is a fifth of |q| + c, so that no expansion shock stands at a sonic line. For the middle
/// wave, which carries entropy and shear, it is a fiftieth: enough to damp the odd-even decay of grid-aligned
/// shocks, and little dissipation of the slow flow near a stagnation point. Beside a strong shock it is
/// `least_middle`.
inline WaveSpeeds wave_speeds(double along, double sound, double least_middle = 0) {
  const double largest = std::abs(along) + sound;
  const auto kept = [](double speed, double delta) {
    speed = std::abs(speed);
    return speed < delta ? (speed * speed + delta * delta) / (2 * delta) : speed;
  };
  return {kept(along + sound, 0.2 * largest), kept(along - sound, 0.2 * largest),
          kept(along, std::max(0.02, least_middle) * largest)};
}

/// The state between two states that linearises the jump from one to the other (Roe 1981).
struct RoeAverage {
  double density, x_velocity, y_velocity, enthalpy, sound;
};

inline RoeAverage roe_average(const Gas& gas, const State& left, const State& right) {
  const double root_left = std::sqrt(left[0]), root_right = std::sqrt(right[0]),
               share = root_right / (root_left + root_right);
  const auto between = [share](double l, double r) { return l + share * (r - l); };
  const double u = between(left[1], right[1]), v = between(left[2], right[2]);
  const double enthalpy = between(gas.total_enthalpy(left), gas.total_enthalpy(right));
  const double sound_squared = (gas.gamma - 1) * (enthalpy - 0.5 * (u * u + v * v));
  return {root_left * root_right, u, v, enthalpy, std::sqrt(sound_squared)};
}

/// |A| dW for the matrix A of the flux along a normal, at a state between, with its wave speeds made
/// positive: middle dW + first [1, u, v, H] + second [0, nx, ny, q]. That form needs no eigenvectors.
/// `pressure` is the change of pressure, `momentum` density times that of q.
struct UpwindPart {
  double first, second;
};
inline UpwindPart upwind_part(const WaveSpeeds& waves, double sound, double pressure, double momentum) {
  const double even = 0.5 * (waves.fast + waves.slow) - waves.middle, odd = 0.5 * (waves.fast - waves.slow);
  return {even * pressure / (sound * sound) + odd * momentum / sound,
          even * momentum + odd * pressure / sound};
}

/// How much of the jump of the speed along the normal waves of sound damp: the larger Mach number, up to 1.
/// With all of it Roe's flux damps slow flow more the slower it is (Rieper 2011).
inline double slow_flow_share(const Gas& gas, const State& left, const State& right) {
  const auto square = [&](const State& s) { return (s[1] * s[1] + s[2] * s[2]) * s[0] / (gas.gamma * s[3]); };
  return std::sqrt(std::min(1.0, std::max(square(left), square(right))));
}

/// What crosses a face of length 1 with this unit normal, which points from `left` to `right` (Roe 1981). The
/// flux of two equal states is the physical one but for rounding. `least_middle` is the least speed of the
/// middle wave, as a share of the largest (ShockSensor); `slow_flow` asks for slow_flow_share.
inline Flux roe_flux(const Gas& gas, const State& left, const State& right, Point normal,
                     double least_middle = 0, bool slow_flow = false) {
  const Flux of_left = physical_flux(gas, left, normal), of_right = physical_flux(gas, right, normal);
  const RoeAverage mean = roe_average(gas, left, right);
  const double along = mean.x_velocity * normal.x + mean.y_velocity * normal.y;
  const WaveSpeeds waves = wave_speeds(along, mean.sound, least_middle);
  const double d_pressure = right[3] - left[3];
  const double d_along = (slow_flow ? slow_flow_share(gas, left, right) : 1) *
                         ((right[1] - left[1]) * normal.x + (right[2] - left[2]) * normal.y);
  const UpwindPart part = upwind_part(waves, mean.sound, d_pressure, mean.density * d_along);
  const Conserved l = gas.conserved(left), r = gas.conserved(right);
  const auto average = [](double a, double b, double dissipation) { return 0.5 * (a + b - dissipation); };
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
