#include "flow/euler/march.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "flow/euler/forces.hpp"
#include "flow/euler/in_time/time_scheme.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/base/parallel/shared_stage.hpp"

namespace quadloop::flow::euler {

double mass_residual(const FlowRun& run, const IdVector<NodeId, Flux>& fluxes) {
  std::vector<double> squares;
  squares.reserve(run.mesh.owned_nodes());
  for (const NodeId node : run.mesh.owned_ids()) squares.push_back(fluxes[node][0] * fluxes[node][0]);
  const auto count = static_cast<double>(run.comm.sum(run.mesh.owned_nodes()));
  return count > 0 ? std::sqrt(reproducible_sum(run.comm, squares) / count) : 0;
}

namespace {

/// Reports progress to the caller's stage: steps, or time if that determines the end of the run.
void tell_progress(const EulerResult& result, bool in_time) {
  progress::SharedStage* const stage = progress::SharedStage::current();
  if (stage == nullptr) return;
  stage->say(fmt::format("step {}  residual {:.1e}", result.iterations, result.residual));
  stage->advance_together(in_time ? result.time : result.iterations);
}

}  // namespace

IdVector<NodeId, State> undisturbed(const FlowRun& run) {
  IdVector<NodeId, State> uniform(run.mesh.nodes(), run.model.free_stream);
  run.residual.no_slip().hold(uniform);
  return uniform;
}

double free_stream_residual(FlowRun& run) {
  IdVector<NodeId, State> uniform = undisturbed(run);
  return mass_residual(run, run.residual.evaluate(uniform));
}

void surround(FlowRun& run, FarField& far_field) {
  if (run.options.far_field != EulerOptions::FarField::vortex) return;
  run.mesh.update(run.states);
  const ForceCoefficients forces = wall_forces(run.comm, run.mesh, run.model, run.states,
                                               run.residual.friction(), run.options.reference_length);
  const double speed = std::hypot(run.model.free_stream[1], run.model.free_stream[2]);
  far_field.set_circulation(0.5 * speed * run.options.reference_length * forces.cl);
  run.residual.surround(far_field);
}

void report(const FlowRun& run, EulerResult& result, double cfl, bool at_end, const Telling& telling) {
  tell_progress(result, telling.in_time);
  const bool is_told =
      run.options.progress && (at_end || result.iterations % run.options.progress_every == 0);
  const bool is_kept = at_end || result.iterations % telling.every == 0;
  if (!is_told && !is_kept) return;
  const ForceCoefficients forces = wall_forces(run.comm, run.mesh, run.model, run.states,
                                               run.residual.friction(), run.options.reference_length);
  if (is_kept)
    result.history.push_back({result.iterations, result.residual, forces.cl, forces.cd, result.time});
  if (!is_told) return;
  if (progress::SharedStage* stage = progress::SharedStage::current())
    stage->say_then(fmt::format("cl {:.4f}  cd {:.5f}", forces.cl, forces.cd));
  run.options.progress({result.iterations, result.residual, forces.cl, forces.cd, result.time, cfl});
}

namespace {

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

/// Returns the first owned node with an unphysical state.
std::int64_t first_without_gas(const FlowRun& run) {
  for (const NodeId node : run.mesh.owned_ids()) {
    if (!is_gas(run.states[node])) return run.mesh.global(node).value();
  }
  return none;
}

/// Returns the first node, over all ranks, of those with the largest flux. *Collective.*
std::int64_t first_of_largest_flux(const FlowRun& run, const IdVector<NodeId, Flux>& fluxes) {
  double worst = -1;
  std::int64_t at = none;
  for (const NodeId node : run.mesh.owned_ids()) {
    double size = std::abs(fluxes[node][0]);
    if (!std::isfinite(size)) size = std::numeric_limits<double>::infinity();
    if (size <= worst) continue;
    worst = size;
    at = run.mesh.global(node).value();
  }
  return run.comm.minimum(worst < run.comm.maximum(worst) ? none : at);
}

}  // namespace

std::string worst_place(const FlowRun& run, const IdVector<NodeId, Flux>& fluxes) {
  std::int64_t at = run.comm.minimum(first_without_gas(run));
  if (at == none) at = first_of_largest_flux(run, fluxes);
  std::vector<double> told;
  for (const NodeId node : run.mesh.owned_ids()) {
    if (run.mesh.global(node) != GlobalNodeId{at}) continue;
    const State& state = run.states[node];
    told = {run.mesh.point(node).x, run.mesh.point(node).y, state[0], state[1], state[2], state[3]};
  }
  told = run.comm.all_gather_values(std::span<const double>(told));
  return fmt::format(
      "at ({:.6g}, {:.6g}), where density is {:.4g}, velocity ({:.4g}, {:.4g}) and pressure {:.4g}", told[0],
      told[1], told[2], told[3], told[4], told[5]);
}

}  // namespace quadloop::flow::euler
