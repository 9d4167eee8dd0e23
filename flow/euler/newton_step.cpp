#include "flow/euler/newton_step.hpp"

#include <algorithm>
#include <cmath>

#include "flow/euler/state_update.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::euler {

namespace {

constexpr int directions = 40;  ///< 64 bytes each for a node: 2.5 kB
constexpr double linear_tolerance = 0.1;
constexpr int sweeps = 30;      ///< of the preconditioner
constexpr double nudge = 1e-6;  ///< the largest entry of the difference that a derivative is taken from
constexpr int most_halvings = 5;

}  // namespace

NewtonStep::NewtonStep(const FlowRun& run, ImplicitSystem& system)
    : run_{run},
      system_{system},
      residual_(run.mesh.owned_nodes()),
      change_(run.mesh.owned_nodes()),
      right_(run.mesh.nodes()),
      preconditioned_(run.mesh.nodes()),
      start_(run.mesh.nodes()),
      moved_(run.mesh.nodes()) {}

NewtonStep::Taken NewtonStep::take(const std::vector<Flux>& fluxes, double cfl,
                                   const std::vector<double>& shares) {
  std::copy_n(fluxes.begin(), residual_.size(), residual_.begin());
  start_ = run_.states;
  system_.assemble(start_, cfl, shares, run_.residual.shocks());
  const double size = norm(residual_), left_over = solve();
  double share = 1;
  for (int attempt = 0; attempt < most_halvings; ++attempt, share *= 0.5) {
    if (advance(share) < size) return {share, left_over};
  }
  run_.states = start_;
  return {0, left_over};
}

/// Returns the share that is left of the residual of the linear system.
double NewtonStep::solve() {
  NodeRows right = residual_;
  for (Flux& row : right) {
    for (double& value : row) value = -value;
  }
  KrylovSystem system;
  system.owned = change_.size();
  system.multiply = [&](const NodeRows& change, NodeRows& product) { differentiate(change, product); };
  system.precondition = [&](const NodeRows& vector, NodeRows& change) {
    for (std::size_t node = 0; node < vector.size(); ++node) {
      for (std::size_t k = 0; k < 4; ++k) right_[node][k] = -vector[node][k];
    }
    system_.relax(right_, sweeps, preconditioned_);
    for (std::size_t node = 0; node < vector.size(); ++node)
      std::ranges::copy(preconditioned_[node], change[node].begin());
  };
  return solve_by_gmres(run_.comm, system, right, change_, linear_tolerance, directions, directions).residual;
}

double NewtonStep::norm(const std::vector<Flux>& fluxes) const {
  std::vector<double> squares;
  squares.reserve(change_.size());
  for (std::size_t node = 0; node < change_.size(); ++node) {
    const Flux& f = fluxes[node];
    squares.push_back(f[0] * f[0] + f[1] * f[1] + (f[2] * f[2] + f[3] * f[3]));
  }
  return std::sqrt(reproducible_sum(run_.comm, squares));
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
  return norm(fluxes);
}

/// (area / time step + derivative) change.
void NewtonStep::differentiate(const NodeRows& change, NodeRows& result) {
  result.resize(change.size());
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
