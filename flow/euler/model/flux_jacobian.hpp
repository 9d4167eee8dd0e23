#pragma once

#include "flow/euler/model/flux.hpp"

namespace quadloop::flow::euler {

/// Derivative of a flux with respect to the conserved variables, row-major.
using Matrix4 = std::array<double, 16>;

/// Decomposition of a flux matrix: `middle` times the identity, plus the contributions of the two acoustic
/// waves: with the change of pressure dp and of momentum along the normal dm (minus the mean motion), (even_p
/// dp + odd_m dm) [1, u, v, H] + (odd_p dp + even_m dm) [0, nx, ny, q].
struct WaveMatrix {
  double middle = 0, first_pressure = 0, first_momentum = 0, second_pressure = 0, second_momentum = 0;
};

/// State and normal of a flux matrix.
struct MatrixPoint {
  double x_velocity, y_velocity, enthalpy;
  Point normal;
};

/// Adds `factor` times the matrix to `sum`.
inline void add_matrix(const Gas& gas, const MatrixPoint& at, const WaveMatrix& waves, double factor,
                       Matrix4& sum) {
  const double u = at.x_velocity, v = at.y_velocity, along = u * at.normal.x + v * at.normal.y,
               g = gas.gamma - 1;
  const std::array<double, 4> pressure{0.5 * g * (u * u + v * v), -g * u, -g * v, g},
      momentum{-along, at.normal.x, at.normal.y, 0};
  const std::array<double, 4> first{1, u, v, at.enthalpy}, second{0, at.normal.x, at.normal.y, along};
  for (std::size_t column = 0; column < 4; ++column) {
    const double a =
        factor * (waves.first_pressure * pressure[column] + waves.first_momentum * momentum[column]);
    const double b =
        factor * (waves.second_pressure * pressure[column] + waves.second_momentum * momentum[column]);
    for (std::size_t row = 0; row < 4; ++row) sum[4 * row + column] += a * first[row] + b * second[row];
    sum[5 * column] += factor * waves.middle;
  }
}

/// Adds the matrix of the physical flux at a state.
inline void add_flux_matrix(const Gas& gas, const State& state, Point normal, double factor, Matrix4& sum) {
  const MatrixPoint at{state[1], state[2], gas.total_enthalpy(state), normal};
  add_matrix(gas, at, {state[1] * normal.x + state[2] * normal.y, 0, 1, 1, 0}, factor, sum);
}

/// Wave speeds of the flux, at least a tenth of the largest (a fifth for acoustic waves): with a vanishing
/// middle wave, implicit steps oscillate near stagnation points.
inline WaveSpeeds steadying_speeds(double along, double sound) {
  const double largest = std::abs(along) + sound;
  const WaveSpeeds waves = wave_speeds(along, sound);
  return {std::max(waves.fast, 0.2 * largest), std::max(waves.slow, 0.2 * largest),
          std::max(waves.middle, 0.1 * largest)};
}

/// Adds the matrix with the absolute values of its eigenvalues, at the mean of two states. Returns the
/// largest eigenvalue. `skewness` is the contribution of SkewEdge to the flux relative to that along the
/// edge; the middle wave, which stabilises it where the flow crosses the edge slowly, is increased by this
/// fraction of the flow speed. `shock_share` is that of the flux.
inline double add_upwind_matrix(const Gas& gas, const State& left, const State& right, Point normal,
                                double factor, Matrix4& sum, double skewness = 0, double shock_share = 0) {
  const RoeAverage mean = roe_average(gas, left, right);
  const double along = mean.x_velocity * normal.x + mean.y_velocity * normal.y, sound = mean.sound;
  WaveSpeeds waves = steadying_speeds(along, sound);
  waves.middle = std::max(waves.middle, shock_share * sound);
  waves.middle += skewness * std::sqrt(mean.x_velocity * mean.x_velocity + mean.y_velocity * mean.y_velocity);
  const UpwindPart by_pressure = upwind_part(waves, sound, 1, 0),
                   by_momentum = upwind_part(waves, sound, 0, 1);
  add_matrix(gas, {mean.x_velocity, mean.y_velocity, mean.enthalpy, normal},
             {waves.middle, by_pressure.first, by_momentum.first, by_pressure.second, by_momentum.second},
             factor, sum);
  return std::abs(along) + sound;
}

}  // namespace quadloop::flow::euler
