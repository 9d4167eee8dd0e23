#include "flow/adjoint/parameter_derivative.hpp"

#include "flow/adjoint/goal_functional.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

/// Terms of psi . flux through the edges for another free-stream Mach number, on which slow flow depends.
void add_edges(const FlowRun& run, const IdVector<NodeId, Flux>& adjoint, const Gas& gas,
               std::vector<double>& terms) {
  for (const DualEdge& edge : run.mesh.edges()) {
    const EdgeStates ends = states_at_middle(edge, run.states, run.residual.gradients());
    const Flux flux =
        roe_flux(gas, ends.left, ends.right, edge.normal, run.residual.shock_share(edge.low, edge.high));
    for (const auto& [node, sign] : {std::pair{edge.low, -1.0}, {edge.high, 1.0}}) {
      if (!run.mesh.is_owned(node)) continue;
      for (std::size_t k = 0; k < 4; ++k) terms.push_back(sign * adjoint[node][k] * edge.size * flux[k]);
    }
  }
}

/// Returns the functional and psi . residual at constant states for another free stream; only boundary and
/// edge fluxes of the residual depend on it.
double held(const FlowRun& run, const std::vector<std::string>& boundaries, const Goal& goal,
            const IdVector<NodeId, Flux>& adjoint, double mach, double alpha) {
  FlowModel model = run.model;
  model.free_stream = model.gas.free_stream(mach, alpha);
  model.gas.least_mach = std::min(mach, 1.0);
  std::vector<double> terms;
  add_edges(run, adjoint, model.gas, terms);
  for (const BoundaryFace& face : run.mesh.faces()) {
    const BoundaryModel& boundary = model.boundaries[face.boundary];
    if (feels_force(boundary.condition) || boundary.condition == Condition::symmetry) continue;
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      if (!run.mesh.is_owned(own)) continue;
      const State state = state_at_half(face, run.states[own], run.states[other]);
      const Flux flux = boundary_flux(model, boundary, state, face.normal);
      for (std::size_t k = 0; k < 4; ++k) terms.push_back(-adjoint[own][k] * face.half_size * flux[k]);
    }
  }
  const GoalFunctional functional(run.comm, run.mesh, model, boundaries, goal, run.options.reference_length);
  return functional.value(run.states) + reproducible_sum(run.comm, terms);
}

}  // namespace

ParameterDerivative parameter_derivative(const FlowRun& run, const std::vector<std::string>& boundaries,
                                         const Goal& goal, const IdVector<NodeId, Flux>& adjoint) {
  // central differences of smooth functions: relative error about 1e-9
  constexpr double degrees = 1e-3, share = 1e-4;
  const double mach = run.options.mach, alpha = run.options.alpha, d_mach = share * mach;
  const auto at = [&](double m, double a) { return held(run, boundaries, goal, adjoint, m, a); };
  return {(at(mach, alpha + degrees) - at(mach, alpha - degrees)) / (2 * degrees),
          (at(mach + d_mach, alpha) - at(mach - d_mach, alpha)) / (2 * d_mach)};
}

}  // namespace quadloop::flow::euler
