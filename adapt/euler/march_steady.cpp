#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/euler/flow_run.hpp"
#include "adapt/euler/implicit_system.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::euler {

namespace {

int env_i(const char*n,int d){const char*v=getenv(n);return v?atoi(v):d;}
double env_d(const char*n,double d){const char*v=getenv(n);return v?atof(v):d;}

constexpr double largest_share = 0.25;  ///< of its density or pressure that a node may gain or lose in a step

/// The change, made smaller where it would take too much of a node's density or pressure.
State updated(const Gas& gas, const State& state, const Change& change) {
  const auto& [rho, u, v, p] = state;
  const double d_pressure = (gas.gamma - 1) * (0.5 * (u * u + v * v) * change[0] - u * change[1] - v * change[2] + change[3]);
  const double relative = std::max(std::abs(change[0]) / rho, std::abs(d_pressure) / p);
  double share = relative > largest_share ? largest_share / relative : 1;
  const Conserved w = gas.conserved(state);
  for (int attempt = 0; attempt < 10; ++attempt) {
    const State next = gas.state({w.mass + share * change[0], w.x_momentum + share * change[1], w.y_momentum + share * change[2], w.energy + share * change[3]});
    if (next[0] > 0.5 * rho && next[3] > 0.5 * p) return next;
    share *= 0.5;
  }
  return state;
}

}  // namespace

EulerResult march_to_steady(const FlowRun& run) {
  ImplicitSystem system(run.comm, run.mesh, run.model);
  std::vector<Change> change(run.mesh.nodes());
  std::vector<State> uniform(run.mesh.nodes(), run.model.free_stream);
  double reference = mass_residual(run, run.residual.evaluate(uniform));
  const int sweeps=env_i("SWEEPS",10); const double maxcfl=env_d("MAXCFL",1000), power=env_d("POW",0.75), freeze=env_d("FREEZE",0);
  EulerResult result;
  for (;; ++result.iterations) {
    const std::vector<Flux>& fluxes = run.residual.evaluate(run.states);
    const double norm = mass_residual(run, fluxes);
    if (!std::isfinite(norm)) throw SolverError("the flow blew up "+worst_place(run, fluxes));
    reference = std::max(reference, result.iterations == 0 ? norm : 0);
    result.residual = reference > 0 ? norm / reference : 0;
    if (freeze>0 && result.residual < freeze) run.residual.freeze_limiter();
    result.converged = result.residual <= run.options.tolerance;
    const double cfl = std::min(maxcfl, run.options.cfl * std::max(1.0, std::pow(result.residual, -power)));
    const bool ends = result.converged || result.iterations >= run.options.iterations;
    report(run, result, cfl, ends);
    if (ends) return result;
    system.assemble(run.states, cfl);
    system.relax(fluxes, sweeps, change);
    for (std::size_t node = 0; node < static_cast<std::size_t>(run.mesh.owned_nodes()); ++node) run.states[node] = updated(run.model.gas, run.states[node], change[node]);
  }
}

}  // namespace quadloop::euler
