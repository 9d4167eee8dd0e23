#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/scheme/viscous.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::euler {

namespace {

constexpr double largest_cfl = 0.8;  ///< of the explicit steps

/// The largest time step of CFL number 1 over all nodes of all ranks: area over half the sum of wave speed
/// times face size. *Collective.*
double unit_time_step(const FlowRun& run, std::vector<double>& wave_sums) {
  const auto speed = [&](std::int32_t node, Point normal) {
    const State& state = run.states[node];
    return std::abs(state[1] * normal.x + state[2] * normal.y) + run.model.gas.sound_speed(state);
  };
  std::fill(wave_sums.begin(), wave_sums.end(), 0.0);
  for (const DualEdge& edge : run.mesh.edges()) {
    const double sum =
        0.5 * edge.size * std::max(speed(edge.low, edge.normal), speed(edge.high, edge.normal)) +
        edge.size / (2 * length(edge.half)) *
            std::max(diffusivity(run.model, run.states[edge.low]),
                     diffusivity(run.model, run.states[edge.high]));
    wave_sums[edge.low] += sum;
    wave_sums[edge.high] += sum;
  }
  for (const BoundaryFace& face : run.mesh.faces()) {
    for (const std::int32_t node : {face.from, face.to})
      wave_sums[node] += 0.5 * face.half_size * speed(node, face.normal);
  }
  double step = std::numeric_limits<double>::infinity();
  const auto areas = run.mesh.areas();
  for (std::size_t node = 0; node < areas.size(); ++node)
    step = std::min(step, areas[node] / wave_sums[node]);
  return run.comm.minimum(step);
}

/// One stage of a strong-stability-preserving Runge-Kutta step (Shu and Osher 1988): the step's start and the
/// stage before it advanced by an Euler step, mixed.
struct Stage {
  double start, advanced;
};
constexpr std::array<Stage, 3> stages{{{0, 1}, {0.75, 0.25}, {1.0 / 3, 2.0 / 3}}};

void advance(const FlowRun& run, const Stage& stage, double step, const std::vector<Conserved>& start,
             const std::vector<Flux>& fluxes) {
  const auto areas = run.mesh.areas();
  const Gas& gas = run.model.gas;
  for (std::size_t node = 0; node < areas.size(); ++node) {
    const Conserved &w0 = start[node], w = gas.conserved(run.states[node]);
    const Flux& flux = fluxes[node];
    const auto mixed = [&](double before, double now, double out) {
      return stage.start * before + stage.advanced * (now - step / areas[node] * out);
    };
    run.states[node] =
        gas.state({mixed(w0.mass, w.mass, flux[0]), mixed(w0.x_momentum, w.x_momentum, flux[1]),
                   mixed(w0.y_momentum, w.y_momentum, flux[2]), mixed(w0.energy, w.energy, flux[3])});
  }
}

}  // namespace

EulerResult march_in_time(const FlowRun& run) {
  std::vector<double> wave_sums(run.mesh.nodes());
  std::vector<Conserved> start(run.mesh.owned_nodes());
  const double cfl = std::min(run.options.cfl, largest_cfl);
  EulerResult result;
  double reference = 0;
  FarField far_field(run.comm, run.mesh, run.model);
  while (true) {
    surround(run, far_field);
    const std::vector<Flux>& fluxes = run.residual.evaluate(run.states);
    const double norm = mass_residual(run, fluxes);
    if (!std::isfinite(norm)) {
      throw SolverError(
          fmt::format("the flow solver failed at time {:.6g} {}; look at the boundary conditions and the "
                      "cells there, or try a smaller cfl",
                      result.time, worst_place(run, fluxes)));
    }
    reference = std::max(reference, result.iterations == 0 ? norm : 0);
    result.residual = reference > 0 ? norm / reference : 0;
    result.converged = result.time >= run.options.end_time;
    const bool ends = result.converged || result.iterations >= run.options.iterations;
    report(run, result, cfl, ends);
    if (ends) return result;
    const double left = run.options.end_time - result.time, full = cfl * unit_time_step(run, wave_sums);
    const bool last = full >= left;
    const double step = last ? left : full;
    for (std::size_t node = 0; node < start.size(); ++node)
      start[node] = run.model.gas.conserved(run.states[node]);
    for (std::size_t k = 0; k < stages.size(); ++k) {
      advance(run, stages[k], step, start, k == 0 ? fluxes : run.residual.evaluate(run.states));
    }
    result.time = last ? run.options.end_time : result.time + step;
    ++result.iterations;
  }
}

}  // namespace quadloop::euler
