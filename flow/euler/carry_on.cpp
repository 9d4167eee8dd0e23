#include <cmath>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/in_time/runge_kutta.hpp"
#include "mesher/base/progress.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::euler {

namespace {

/// Of a flow-through time. More explicit steps take longer than implicit ones that show what moves.
constexpr int most_explicit_steps = 2000;
constexpr int implicit_steps = 40;

/// The longer side of the box of all that feels a force, or without such of the whole mesh, over the free
/// stream's speed. *Collective.*
double flow_through_time(const FlowRun& run) {
  std::vector<Point> of_walls, all;
  for (std::int32_t node = 0; node < run.mesh.owned_nodes(); ++node) all.push_back(run.mesh.point(node));
  for (const BoundaryFace& face : run.mesh.faces()) {
    if (!feels_force(run.model.boundaries[face.boundary].condition)) continue;
    for (const std::int32_t node : {face.from, face.to}) of_walls.push_back(run.mesh.point(node));
  }
  const bool has_walls = run.comm.any(!of_walls.empty());
  const Box box = box_over_ranks(run.comm, has_walls ? of_walls : all);
  const double length = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return length / std::hypot(run.model.free_stream[1], run.model.free_stream[2]);
}

/// Explicit steps where they are not too many for each flow-through time; else implicit ones.
TimePlan plan_of(const FlowRun& run) {
  const double flow_through = flow_through_time(run);
  const TimeRun in_time{run.comm, run.mesh, run.model, run.residual, run.states};
  const double explicit_step = RungeKutta(in_time, run.options.cfl).longest_step();
  TimePlan plan;
  plan.end = run.options.flow_throughs * flow_through;
  plan.average_from = 0.5 * plan.end;
  plan.step = run.options.time_step;
  if (!plan.step && explicit_step * most_explicit_steps < flow_through)
    plan.step = flow_through / implicit_steps;
  const double steps = plan.end / plan.step.value_or(explicit_step);
  plan.most_steps = static_cast<int>(std::min(1e9, 10 * steps + 100));  // faster flow takes shorter steps
  plan.reference = free_stream_residual(run);
  plan.tolerance = run.options.tolerance;
  return plan;
}

}  // namespace

void carry_on(const FlowRun& run, EulerResult& result, TimeAverage& average) {
  run.residual.release_limiter();
  run.mesh.exchange().update(run.states);
  const TimePlan plan = plan_of(run);
  const progress::Stage stage("carrying on in time", plan.end, "units of time");
  const int steady_steps = result.iterations;
  const double steady_residual = result.residual;
  march_in_time(run, plan, result, average);
  if (!result.unsteady) return;
  result.unsteady->steady_steps = steady_steps;
  result.unsteady->steady_residual = steady_residual;
}

}  // namespace quadloop::euler
