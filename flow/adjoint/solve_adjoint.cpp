#include "flow/adjoint/solve_adjoint.hpp"

#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/krylov.hpp"
#include "flow/euler/model/dual_number.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr int sweeps = 12, restart = 60;
constexpr double cfl = 1000;  ///< of the preconditioner

/// Returns the derivatives of the states with respect to the conserved variables.
IdVector<NodeId, Matrix4> states_by_conserved(const FlowRun& run) {
  using Dual = DualNumber<4>;
  IdVector<NodeId, Matrix4> matrices(run.mesh.owned_nodes());
  for (const NodeId node : matrices.ids()) {
    const Conserved w = run.model.gas.conserved(run.states[node]);
    const StateOf<Dual> state =
        run.model.gas.state(ConservedOf<Dual>{Dual::variable(w.mass, 0), Dual::variable(w.x_momentum, 1),
                                              Dual::variable(w.y_momentum, 2), Dual::variable(w.energy, 3)});
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 4; ++column)
        matrices[node][4 * row + column] = state[row].slopes[column];
    }
  }
  return matrices;
}

/// Converts weights of states to weights of conserved variables.
void to_conserved(const IdVector<NodeId, Matrix4>& matrices, NodeRows& rows) {
  for (const NodeId node : matrices.ids()) {
    const std::array<double, 4> of_state = rows[node];
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = 0;
      for (std::size_t row = 0; row < 4; ++row) sum += matrices[node][4 * row + column] * of_state[row];
      rows[node][column] = sum;
    }
  }
  std::fill(rows.begin() + static_cast<std::ptrdiff_t>(matrices.size()), rows.end(), std::array<double, 4>{});
}

}  // namespace

Adjoint solve_adjoint(const LinearResidual& linear, const IdVector<NodeId, State>& of_goal,
                      const AdjointSolve& how) {
  const FlowRun& run = linear.run();
  const IdVector<NodeId, Matrix4> matrices = states_by_conserved(run);
  ImplicitSystem first_order(run.comm, run.mesh, run.model, ImplicitSystem::Sense::transposed);
  first_order.assemble(run.states, cfl, IdVector<NodeId, double>(run.mesh.owned_nodes(), 1.0),
                       run.residual.shocks());
  IdVector<NodeId, Change> change(run.mesh.nodes());
  KrylovSystem system;
  system.owned = run.mesh.owned_nodes();
  system.multiply = [&](NodeRows& x, NodeRows& product) {
    linear.apply_transposed(x, product);
    to_conserved(matrices, product);
  };
  system.precondition = [&](const NodeRows& right, NodeRows& x) {
    first_order.relax(right, sweeps, change);  // solves for the negative right side
    for (const NodeId node : run.mesh.owned_ids()) {
      for (std::size_t k = 0; k < 4; ++k) x[node][k] = -static_cast<double>(change[node][k]);
    }
  };
  NodeRows right = of_goal;
  to_conserved(matrices, right);
  Adjoint adjoint;
  const KrylovEnd end =
      solve_by_gmres(run.comm, system, right, adjoint.weights, how.tolerance, how.iterations, restart);
  run.mesh.exchange().update(adjoint.weights);
  adjoint.iterations = end.iterations;
  adjoint.residual = end.residual;
  adjoint.converged = end.residual <= how.tolerance;
  return adjoint;
}

}  // namespace quadloop::flow::euler
