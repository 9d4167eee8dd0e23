#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flow/euler/in_time/runge_kutta.hpp"
#include "flow/euler/march.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::flow::euler {

namespace {

/// Limit per flow-through time. More explicit steps would cost more than implicit steps that resolve the
/// motion.
constexpr int most_explicit_steps = 2000;
constexpr int implicit_steps = 40;

/// Longer side of the bounding box of all boundaries with a force, or else of the whole mesh, over the
/// free-stream speed. *Collective.*
double flow_through_time(const FlowRun& run) {
  std::vector<Point> of_walls, all;
  for (const NodeId node : run.mesh.owned_ids()) all.push_back(run.mesh.point(node));
  for (const BoundaryFace& face : run.mesh.faces()) {
    if (!feels_force(run.model.boundaries[face.boundary].condition)) continue;
    for (const NodeId node : {face.from, face.to}) of_walls.push_back(run.mesh.point(node));
  }
  const bool has_walls = run.comm.any(!of_walls.empty());
  const Box box = box_over_ranks(run.comm, has_walls ? of_walls : all);
  const double length = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return length / std::hypot(run.model.free_stream[1], run.model.free_stream[2]);
}

/// Duration and step size: explicit steps unless they are too many per flow-through time, else implicit
/// steps.
struct Course {
  double flow_through, explicit_step;
  std::optional<double> step;

  double end(const EulerOptions& options) const { return options.flow_throughs * flow_through; }
  double steps(const EulerOptions& options) const { return end(options) / step.value_or(explicit_step); }
};

Course course_of(FlowRun& run) {
  run.mesh.update(run.states);
  Course course{flow_through_time(run), RungeKutta(run, run.options.cfl).longest_step(),
                run.options.time_step};
  if (!course.step && course.explicit_step * most_explicit_steps < course.flow_through)
    course.step = course.flow_through / implicit_steps;
  return course;
}

TimePlan plan_of(FlowRun& run) {
  const Course course = course_of(run);
  TimePlan plan;
  plan.end = course.end(run.options);
  plan.average_from = 0.5 * plan.end;
  plan.step = course.step;
  plan.most_steps = static_cast<int>(
      std::min(1e9, 10 * course.steps(run.options) + 100));  // a faster flow needs shorter steps
  plan.reference = free_stream_residual(run);
  plan.tolerance = run.options.tolerance;
  return plan;
}

/// The steps may have become ever shorter.
std::string early_end(int steps, double time, const TimePlan& plan) {
  return fmt::format("{} time steps only reached time {:.6g} of {:.6g}; set a time_step", steps, time,
                     plan.end);
}

}  // namespace

void require_few_steps(FlowRun& run) {
  const EulerOptions& options = run.options;
  const Course course = course_of(run);
  const double steps = course.steps(options);
  if (steps <= most_steps_in_time) return;
  const std::string number = fmt::format(
      "continuing the flow for {:.6g} convective times of {:.6g} each would take {:.2g} steps of {:.2g}, but "
      "at most {:.0f} are allowed",
      options.flow_throughs, course.flow_through, steps, course.step.value_or(course.explicit_step),
      most_steps_in_time);
  if (!options.time_step || course.flow_through / implicit_steps <= *options.time_step)
    throw InputError(number + "; reduce solver.flow_throughs");
  throw InputError(fmt::format("{}; a solver.time_step of {:.2g} would be a fortieth of a convective time",
                               number, course.flow_through / implicit_steps));
}

void continue_in_time(FlowRun& run, EulerResult& result, TimeAverage& average) {
  const EulerResult steady = result;
  const IdVector<NodeId, State> steady_states = run.states;
  std::string failure;
  run.residual.release_limiter();
  try {
    const TimePlan plan = plan_of(run);
    const progress::SharedStage stage(run.comm, "continuing in time", plan.end, "units of time");
    march_in_time(run, plan, result, average);
    if (!result.converged) failure = early_end(result.iterations - steady.iterations, result.time, plan);
  } catch (const SolverError& error) {  // the same on all ranks
    failure = error.what();
  }
  if (failure.empty()) {
    if (!result.unsteady) return;
    result.unsteady->continued = true;
    result.unsteady->steady_steps = steady.iterations;
    result.unsteady->steady_residual = steady.residual;
    return;
  }
  result = steady;
  result.failed_in_time = failure;
  average = {};
  run.states = steady_states;
  FarField far_field(run.comm, run.mesh, run.model);
  surround(run, far_field);
}

}  // namespace quadloop::flow::euler
