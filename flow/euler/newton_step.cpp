#include "flow/euler/newton_step.hpp"

#include <algorithm>
#include <cmath>

#include "flow/euler/state_update.hpp"

namespace quadloop::euler {

namespace {

constexpr std::size_t directions = 40;  ///< 48 numbers each for a node: 2 kB
constexpr double linear_tolerance = 0.1;
constexpr int sweeps = 30;      ///< of the preconditioner
constexpr double nudge = 1e-6;  ///< the largest entry of the difference that a derivative is taken from
constexpr int most_halvings = 5;

}  // namespace

NewtonStep::NewtonStep(const FlowRun& run, ImplicitSystem& system)
    : run_{run},
      system_{system},
      gmres_(run.comm, run.mesh.owned_nodes(), directions),
      residual_(run.mesh.owned_nodes()),
      change_(run.mesh.owned_nodes()),
      right_(run.mesh.nodes()),
      start_(run.mesh.nodes()),
      moved_(run.mesh.nodes()) {}

NewtonStep::Taken NewtonStep::take(const std::vector<Flux>& fluxes, double cfl,
                                   const std::vector<double>& shares) {
  std::copy_n(fluxes.begin(), residual_.size(), residual_.begin());
  start_ = run_.states;
  system_.assemble(start_, cfl, shares);
  const double size = gmres_.norm(residual_), left_over = solve();
  double share = 1;
  for (int attempt = 0; attempt < most_halvings; ++attempt, share *= 0.5) {
    if (advance(share) < size) return {share, left_over};
  }
  run_.states = start_;
  return {0, left_over};
}

/// Returns the share that is left of the residual of the linear system.
double NewtonStep::solve() {
  Gmres::Vector right = residual_;
  for (Flux& row : right) {
    for (double& value : row) value = -value;
  }
  const auto apply = [&](const Gmres::Vector& change, Gmres::Vector& result) {
    differentiate(change, result);
  };
  const auto precondition = [&](const Gmres::Vector& vector, std::vector<Change>& change) {
    for (std::size_t node = 0; node < vector.size(); ++node) {
      for (std::size_t k = 0; k < 4; ++k) right_[node][k] = -vector[node][k];
    }
    change.resize(run_.mesh.nodes());
    system_.relax(right_, sweeps, change);
  };
  return gmres_.solve(right, linear_tolerance, apply, precondition, change_);
}

/// The residual's norm after that share of the change.
double NewtonStep::advance(double share) {
  for (std::size_t node = 0; node < change_.size(); ++node) {
    std::array<double, 4> change = change_[node];
    for (double& value : change) value *= share;
    run_.states[node] = updated(run_.model.gas, start_[node], change);
  }
  run_.residual.no_slip().hold(run_.states);
  const std::vector<Flux>& fluxes = run_.residual.evaluate(run_.states);
  return gmres_.norm({fluxes.begin(), fluxes.begin() + static_cast<std::ptrdiff_t>(change_.size())});
}

/// (area / time step + derivative) change.
void NewtonStep::differentiate(const Gmres::Vector& change, Gmres::Vector& result) {
  double largest = 0;
  for (const Flux& row : change) {
    for (const double value : row) largest = std::max(largest, std::abs(value));
  }
  largest = run_.comm.maximum(largest);
  const double step = largest > 0 ? nudge / largest : 0;
  const Gas& gas = run_.model.gas;
  for (std::size_t node = 0; node < change.size(); ++node) {
    const Conserved w = gas.conserved(start_[node]);
    const Flux& d = change[node];
    moved_[node] = gas.state({w.mass + step * d[0], w.x_momentum + step * d[1], w.y_momentum + step * d[2],
                              w.energy + step * d[3]});
  }
  run_.residual.no_slip().hold(moved_);
  const std::vector<Flux>& fluxes = run_.residual.evaluate(moved_);
  const std::vector<double>& time_terms = system_.time_terms();
  for (std::size_t node = 0; node < change.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double derivative = step > 0 ? (fluxes[node][k] - residual_[node][k]) / step : 0;
      result[node][k] = derivative + time_terms[node] * change[node][k];
    }
  }
}

}  // namespace quadloop::euler
