#include "flow/euler/in_time/backward_difference.hpp"

#include <algorithm>
#include <cmath>

#include "flow/euler/implicit/state_update.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr NewtonSystem::Effort effort_in_time{.tolerance = 0.1, .directions = 20, .sweeps = 10};
constexpr double tolerance = 1e-3;  ///< relative to the imbalance of unchanged states
constexpr double rounding = 1e-13;  ///< relative to the conserved variables
constexpr int most_iterations = 10, most_share_halvings = 3;
constexpr double least_gain = 0.9;  ///< reduction per iteration; with less the iteration stops
constexpr int most_step_halvings = 4;
constexpr double longest_growth = 2.1;  ///< ratio of a step to the previous one; a larger ratio uses order 1

std::array<double, 4> row_of(const Conserved& w) { return {w.mass, w.x_momentum, w.y_momentum, w.energy}; }

}  // namespace

BackwardDifference::BackwardDifference(FlowRun& run, double step)
    : run_{run},
      step_{step},
      system_(run.comm, run.mesh, run.model),
      newton_(run.comm, run.mesh, run.model, run.residual, system_),
      held_(run.residual.no_slip().held_rows(run.mesh.owned_nodes())),
      last_(run.mesh.owned_nodes()),
      before_(run.mesh.owned_nodes()),
      known_(run.mesh.owned_nodes()),
      fluxes_(run.mesh.owned_nodes()),
      balance_(run.mesh.owned_nodes()),
      change_(run.mesh.owned_nodes()) {}

/// `ratio`: this step over the previous one; 0 if there is none.
BackwardDifference::Weights BackwardDifference::weights(double ratio) {
  return {(1 + 2 * ratio) / (1 + ratio), -(1 + ratio), ratio * ratio / (1 + ratio)};
}

void BackwardDifference::find_known(const Weights& weights, double step) {
  for (const NodeId node : known_.ids()) {
    const double over_step = run_.mesh.areas()[node] / step;
    for (std::size_t k = 0; k < 4; ++k)
      known_[node][k] = over_step * (weights.last * last_[node][k] + weights.before * before_[node][k]);
  }
}

/// Computes the imbalance of the states with these fluxes; returns its norm.
double BackwardDifference::measure(const IdVector<NodeId, Flux>& fluxes, double rate) {
  for (const NodeId node : balance_.ids()) {
    const Row w = row_of(run_.model.gas.conserved(run_.states[node]));
    fluxes_[node] = fluxes[node];
    for (std::size_t k = 0; k < 4; ++k)
      balance_[node][k] = rate * run_.mesh.areas()[node] * w[k] + known_[node][k] + fluxes[node][k];
    for (int k = 1; k <= held_[node]; ++k) balance_[node][k] = 0;
  }
  return newton_.norm(balance_);
}

/// Extrapolates the states from the previous step, if that reduces the imbalance. Returns the new imbalance;
/// `size` is the present one.
double BackwardDifference::go_on(double ratio, double rate, double size) {
  start_ = run_.states;
  for (const NodeId node : change_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) change_[node][k] = ratio * (last_[node][k] - before_[node][k]);
    run_.states[node] = updated(run_.model.gas, start_[node], change_[node]);
  }
  run_.residual.no_slip().hold(run_.states);
  const double gone_on = measure(run_.residual.evaluate(run_.states), rate);
  if (gone_on < size) return gone_on;
  run_.states = start_;
  return measure(run_.residual.evaluate(run_.states), rate);
}

/// Performs one Newton iteration. Returns the new imbalance; the states are unchanged if no fraction of the
/// change lowers it.
double BackwardDifference::newton(double rate, double size, double enough) {
  start_ = run_.states;
  NodeRows right = balance_;
  for (Row& row : right) {
    for (double& value : row) value = -value;
  }
  const NodeRows fluxes = fluxes_;
  NewtonSystem::Effort asked = effort_in_time;
  asked.tolerance = std::clamp(0.5 * enough / size, 0.01, effort_in_time.tolerance);
  newton_.solve(start_, fluxes, right, asked, change_);
  double share = 1;
  for (int attempt = 0; attempt < most_share_halvings; ++attempt, share *= 0.5) {
    for (const NodeId node : change_.ids()) {
      Row change = change_[node];
      for (double& value : change) value *= share;
      run_.states[node] = updated(run_.model.gas, start_[node], change);
    }
    run_.residual.no_slip().hold(run_.states);
    const double now = measure(run_.residual.evaluate(run_.states), rate);
    if (now < size) return now;
  }
  run_.states = start_;
  return size;
}

/// Returns whether the equations of the step were solved to the tolerance.
bool BackwardDifference::solve(double step, const NodeRows& fluxes) {
  const double ratio = last_step_ > 0 && step <= longest_growth * last_step_ ? step / last_step_ : 0;
  const Weights weight = weights(ratio);
  const double rate = weight.next / step;
  NodeRows whole = last_;
  for (const NodeId node : whole.ids()) {
    for (double& value : whole[node]) value *= rate * run_.mesh.areas()[node];
  }
  find_known(weight, step);
  double size = measure(fluxes, rate);
  const double enough = std::max(tolerance * size, rounding * newton_.norm(whole));
  if (ratio > 0) size = go_on(ratio, rate, size);
  system_.assemble_with_rate(run_.states, rate, run_.residual.shocks());
  for (int iteration = 0; iteration < most_iterations && size > enough; ++iteration) {
    const double now = newton(rate, size, enough);
    if (!(now < least_gain * size)) break;
    size = now;
  }
  return size <= enough;
}

/// Stores the states at the start of a step.
void BackwardDifference::remember() {
  for (const NodeId node : last_.ids()) last_[node] = row_of(run_.model.gas.conserved(run_.states[node]));
}

NodeRows BackwardDifference::of_owned(const IdVector<NodeId, Flux>& fluxes) const {
  return NodeRows(std::vector<Flux>(fluxes.begin(), fluxes.begin() + run_.mesh.owned_nodes()));
}

/// Returns whether the step, or each of its parts, was solved.
bool BackwardDifference::take(double step, const NodeRows& fluxes, int halvings) {
  const IdVector<NodeId, State> start = run_.states;
  const NodeRows earlier = before_;
  std::swap(before_, last_);
  remember();
  const bool is_solved = solve(step, fluxes);
  if (is_solved || halvings == 0) {
    last_step_ = step;
    return is_solved;
  }
  last_ = before_;
  before_ = earlier;
  run_.states = start;
  const bool first_is_solved = take(0.5 * step, fluxes, halvings - 1);
  return take(0.5 * step, of_owned(run_.residual.evaluate(run_.states)), halvings - 1) && first_is_solved;
}

/// Always true, as updates keep density and pressure positive at every node.
bool BackwardDifference::advance(double step, const IdVector<NodeId, Flux>& fluxes) {
  if (!take(step, of_owned(fluxes), most_step_halvings)) ++unsolved_;
  return true;
}

}  // namespace quadloop::flow::euler
