#include "flow/euler/implicit/state_update.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::flow::euler {

namespace {

constexpr double largest_share = 0.25;  ///< maximum relative change of a node's density or pressure in a step
/// Fraction of the free-stream density and pressure. A node with less, e.g. behind a blunt body at startup,
/// may gain faster, as it would otherwise need hundreds of steps to leave the vacuum.
constexpr double least_reference = 0.1;

double relative_change(double change, double value, double least_divisor) {
  return change < 0 ? -change / value : change / std::max(value, least_divisor);
}

}  // namespace

State updated(const Gas& gas, const State& state, const std::array<double, 4>& d) {
  const auto& [rho, u, v, p] = state;
  const double d_pressure = (gas.gamma - 1) * (0.5 * (u * u + v * v) * d[0] - u * d[1] - v * d[2] + d[3]);
  const double relative = std::max(relative_change(d[0], rho, least_reference),
                                   relative_change(d_pressure, p, least_reference / gas.gamma));
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

}  // namespace quadloop::flow::euler
