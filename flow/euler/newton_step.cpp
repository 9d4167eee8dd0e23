#include "flow/euler/newton_step.hpp"

#include <algorithm>

#include "flow/euler/implicit/state_update.hpp"
#include "flow/euler/steady_parameters.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr SteadyParameters::Newton newton_parameters = steady_parameters.newton;
constexpr NewtonSystem::Effort effort{.tolerance = newton_parameters.tolerance,
                                      .directions = newton_parameters.directions,
                                      .sweeps = newton_parameters.sweeps};

}  // namespace

NewtonStep::NewtonStep(FlowRun& run, ImplicitSystem& system)
    : run_{run},
      system_{system},
      newton_(run.comm, run.mesh, run.model, run.residual, system),
      residual_(run.mesh.owned_nodes()),
      change_(run.mesh.owned_nodes()) {}

NewtonStep::Taken NewtonStep::take(const IdVector<NodeId, Flux>& fluxes, double cfl,
                                   const IdVector<NodeId, double>& shares) {
  std::copy_n(fluxes.begin(), residual_.size(), residual_.begin());
  start_ = run_.states;
  system_.assemble(start_, cfl, shares, run_.residual.shocks());
  const double size = newton_.norm(residual_), left_over = solve();
  double share = 1;
  for (int attempt = 0; attempt < newton_parameters.halvings; ++attempt, share *= 0.5) {
    if (advance(share) < size) return {share, left_over};
  }
  run_.states = start_;
  return {0, left_over};
}

/// Returns the remaining relative residual of the linear system.
double NewtonStep::solve() {
  NodeRows right = residual_;
  for (Flux& row : right) {
    for (double& value : row) value = -value;
  }
  return newton_.solve(start_, residual_, right, effort, change_);
}

/// Returns the residual norm after this fraction of the change.
double NewtonStep::advance(double share) {
  for (const NodeId node : change_.ids()) {
    std::array<double, 4> change = change_[node];
    for (double& value : change) value *= share;
    run_.states[node] = updated(run_.model.gas, start_[node], change);
  }
  run_.residual.no_slip().hold(run_.states);
  return newton_.norm(run_.residual.evaluate(run_.states));
}

}  // namespace quadloop::flow::euler
