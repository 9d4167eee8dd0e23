#include "flow/euler/state_update.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::euler {

namespace {

constexpr double largest_share = 0.25;  ///< of its density or pressure that a node may gain or lose in a step

}  // namespace

State updated(const Gas& gas, const State& state, const std::array<double, 4>& d) {
  const auto& [rho, u, v, p] = state;
  const double d_pressure = (gas.gamma - 1) * (0.5 * (u * u + v * v) * d[0] - u * d[1] - v * d[2] + d[3]);
  const double relative = std::max(std::abs(d[0]) / rho, std::abs(d_pressure) / p);
  double share = relative > largest_share ? largest_share / relative : 1;
  const Conserved w = gas.conserved(state);
  for (int attempt = 0; attempt < 10; ++attempt) {
    const State next = gas.state({w.mass + share * d[0], w.x_momentum + share * d[1],
                                  w.y_momentum + share * d[2], w.energy + share * d[3]});
    if (next[0] > 0.5 * rho && next[3] > 0.5 * p) return next;
    share *= 0.5;
  }
  return state;
}

}  // namespace quadloop::euler
