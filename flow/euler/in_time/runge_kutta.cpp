#include "flow/euler/in_time/runge_kutta.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "flow/euler/scheme/viscous.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr double largest_explicit_cfl = 0.8;
constexpr int most_halvings_of_step = 8;

/// One stage of a step: a combination of the start of the step and the previous stage advanced by an Euler
/// step.
struct Stage {
  double start, advanced;
};
constexpr std::array<Stage, 3> stages{{{0, 1}, {0.75, 0.25}, {1.0 / 3, 2.0 / 3}}};

void advance_stage(FlowRun& run, const Stage& stage, double step, const IdVector<NodeId, Conserved>& start,
                   const IdVector<NodeId, Flux>& fluxes) {
  const auto areas = run.mesh.areas();
  const Gas& gas = run.model.gas;
  for (const NodeId node : areas.ids()) {
    const Conserved &w0 = start[node], w = gas.conserved(run.states[node]);
    const Flux& flux = fluxes[node];
    const auto mixed = [&](double before, double now, double out) {
      return stage.start * before + stage.advanced * (now - step / areas[node] * out);
    };
    run.states[node] =
        gas.state({mixed(w0.mass, w.mass, flux[0]), mixed(w0.x_momentum, w.x_momentum, flux[1]),
                   mixed(w0.y_momentum, w.y_momentum, flux[2]), mixed(w0.energy, w.energy, flux[3])});
  }
  run.residual.no_slip().hold(run.states);
}

}  // namespace

RungeKutta::RungeKutta(FlowRun& run, double cfl)
    : run_{run},
      cfl_{std::min(cfl, largest_explicit_cfl)},
      wave_sums_(run.mesh.nodes()),
      start_(run.mesh.owned_nodes()) {}

/// CFL number times the minimum over all nodes of all ranks of area over half the sum of wave speed times
/// face size.
double RungeKutta::longest_step() {
  const auto speed = [&](NodeId node, Point normal) {
    const State& state = run_.states[node];
    return std::abs(state[1] * normal.x + state[2] * normal.y) + run_.model.gas.sound_speed(state);
  };
  std::fill(wave_sums_.begin(), wave_sums_.end(), 0.0);
  for (const DualEdge& edge : run_.mesh.edges()) {
    const double sum =
        0.5 * edge.size * std::max(speed(edge.low, edge.normal), speed(edge.high, edge.normal)) +
        edge.size / (2 * length(edge.half)) *
            std::max(diffusivity(run_.model, run_.states[edge.low]),
                     diffusivity(run_.model, run_.states[edge.high]));
    wave_sums_[edge.low] += sum;
    wave_sums_[edge.high] += sum;
  }
  for (const BoundaryFace& face : run_.mesh.faces()) {
    for (const NodeId node : {face.from, face.to})
      wave_sums_[node] += 0.5 * face.half_size * speed(node, face.normal);
  }
  double step = std::numeric_limits<double>::infinity();
  const auto areas = run_.mesh.areas();
  for (const NodeId node : areas.ids()) step = std::min(step, areas[node] / wave_sums_[node]);
  return cfl_ * run_.comm.minimum(step);
}

bool RungeKutta::advance(double step, const IdVector<NodeId, Flux>& fluxes) {
  return take(step, fluxes, most_halvings_of_step);
}

/// With the shortest steps the states of the first failed stage are kept, as later stages spread the failure.
bool RungeKutta::take(double step, const IdVector<NodeId, Flux>& fluxes, int halvings) {
  const IdVector<NodeId, State> before = run_.states;
  for (const NodeId node : start_.ids()) start_[node] = run_.model.gas.conserved(before[node]);
  std::optional<IdVector<NodeId, State>> failed;  // also needed on ranks without nodes
  for (std::size_t k = 0; k < stages.size(); ++k) {
    advance_stage(run_, stages[k], step, start_, k == 0 ? fluxes : run_.residual.evaluate(run_.states));
    if (halvings == 0 && !failed && !is_everywhere(is_gas)) failed = run_.states;
  }
  if (is_everywhere(is_gas)) return true;
  if (halvings == 0) {
    if (is_everywhere(is_finite)) return true;  // slightly unphysical values may recover
    run_.states = *failed;
    return false;
  }
  run_.states = before;
  const auto take_half = [&] { return take(0.5 * step, run_.residual.evaluate(run_.states), halvings - 1); };
  return take_half() && take_half();
}

bool RungeKutta::is_everywhere(bool (*holds)(const State&)) const {
  const std::span<const State> own = std::span(run_.states).first(start_.size());
  return !run_.comm.any(!std::ranges::all_of(own, holds));
}

}  // namespace quadloop::flow::euler
