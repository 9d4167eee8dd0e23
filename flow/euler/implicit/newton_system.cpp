#include "flow/euler/implicit/newton_system.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr double nudge = 1e-6;  ///< largest entry of the difference for a directional derivative

}  // namespace

NewtonSystem::NewtonSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                           Residual& residual, ImplicitSystem& system)
    : comm_{comm},
      mesh_{mesh},
      model_{model},
      residual_{residual},
      system_{system},
      right_(mesh.nodes()),
      preconditioned_(mesh.nodes()),
      moved_(mesh.nodes()) {}

double NewtonSystem::solve(const IdVector<NodeId, State>& states, const NodeRows& fluxes,
                           const NodeRows& right, const Effort& effort, NodeRows& change) {
  states_ = &states;
  fluxes_ = &fluxes;
  KrylovSystem system;
  system.owned = mesh_.owned_nodes();
  system.multiply = [&](const NodeRows& vector, NodeRows& product) { differentiate(vector, product); };
  system.precondition = [&](const NodeRows& vector, NodeRows& result) {
    for (const NodeId node : vector.ids()) {
      for (std::size_t k = 0; k < 4; ++k) right_[node][k] = -vector[node][k];
    }
    system_.relax(right_, effort.sweeps, preconditioned_);
    for (const NodeId node : vector.ids()) std::ranges::copy(preconditioned_[node], result[node].begin());
  };
  return solve_by_gmres(comm_, system, right, change, effort.tolerance, effort.directions, effort.directions)
      .residual;
}

double NewtonSystem::norm(const NodeRows& rows) const {
  std::vector<double> squares;
  squares.reserve(mesh_.owned_nodes());
  for (const NodeId node : mesh_.owned_ids()) {
    const auto& f = rows[node];
    squares.push_back(f[0] * f[0] + f[1] * f[1] + (f[2] * f[2] + f[3] * f[3]));
  }
  return std::sqrt(reproducible_sum(comm_, squares));
}

/// Computes (area / time step + derivative) change.
void NewtonSystem::differentiate(const NodeRows& change, NodeRows& result) {
  result.resize(change.size());
  double largest = 0;
  for (const auto& row : change) {
    for (const double value : row) largest = std::max(largest, std::abs(value));
  }
  largest = comm_.maximum(largest);
  const double step = largest > 0 ? nudge / largest : 0;
  for (const NodeId node : change.ids()) {
    const Conserved w = model_.gas.conserved((*states_)[node]);
    const auto& d = change[node];
    moved_[node] = model_.gas.state({w.mass + step * d[0], w.x_momentum + step * d[1],
                                     w.y_momentum + step * d[2], w.energy + step * d[3]});
  }
  residual_.no_slip().hold(moved_);
  const IdVector<NodeId, Flux>& fluxes = residual_.evaluate(moved_);
  const IdVector<NodeId, double>& time_terms = system_.time_terms();
  for (const NodeId node : change.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double derivative = step > 0 ? (fluxes[node][k] - (*fluxes_)[node][k]) / step : 0;
      result[node][k] = derivative + time_terms[node] * change[node][k];
    }
  }
}

}  // namespace quadloop::flow::euler
