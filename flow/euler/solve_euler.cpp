#include "flow/euler/solve_euler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "flow/euler/forces.hpp"
#include "flow/euler/joined_flow.hpp"
#include "flow/euler/march.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::flow {

namespace {

using namespace euler;

std::vector<std::string> flow_names() { return {euler_names.begin(), euler_names.end()}; }

/// Whether the start is a time average and this run continues from its end.
bool goes_on_in_time(const EulerOptions& options, const Field& start) {
  if (options.time == EulerOptions::Time::steady && options.unsteady == EulerOptions::Unsteady::stop)
    return false;
  return std::ranges::all_of(at_end_names, [&](const char* name) {
    return std::ranges::find(start.names, name) != start.names.end();
  });
}

/// Sets the owned nodes' states from the variables of these names.
void take_start(const DualMesh& dual, const Field& start, const std::vector<std::string>& names,
                IdVector<NodeId, State>& states) {
  const Field given = selected(start, names, "the starting state");
  const std::size_t owned = dual.owned_nodes();
  QUADLOOP_REQUIRE(given.values.size() == 4 * owned, "a row for each owned node", given.values.size(), owned);
  for (const NodeId node : dual.owned_ids()) std::ranges::copy(given.row(node), states[node].begin());
}

/// Returns a state for each node; ghosts are set later.
IdVector<NodeId, State> start_states(const Communicator& comm, const Mesh& mesh, const DualMesh& dual,
                                     const FlowModel& model, const EulerOptions& options,
                                     const Field& start) {
  IdVector<NodeId, State> states(dual.nodes(), model.free_stream);
  if (start.width() > 0) {
    const std::vector<std::string> at_end(at_end_names.begin(), at_end_names.end());
    take_start(dual, start, goes_on_in_time(options, start) ? at_end : flow_names(), states);
  } else if (options.initial == EulerOptions::Initial::vortex) {
    const Point centre =
        options.vortex_centre ? *options.vortex_centre : box_over_ranks(comm, mesh.points).centre();
    const Vortex vortex{model.gas, model.free_stream, centre, options.reference_length};
    for (const NodeId node : dual.owned_ids()) states[node] = vortex.state(dual.point(node), 0);
  }
  return states;
}

/// Stores flow and forces of the run's states, with this wall friction. *Collective.*
void take_flow(const FlowRun& run, const std::vector<BoundaryEdges>& boundaries,
               const IdVector<NodeId, Point>& friction, EulerResult& result) {
  const bool viscous = run.model.is_viscous();
  const ForceCoefficients forces =
      wall_forces(run.comm, run.mesh, run.model, run.states, friction, run.options.reference_length);
  result.cl = forces.cl;
  result.cd = forces.cd;
  result.cl_friction = forces.cl_friction;
  result.cd_friction = forces.cd_friction;
  result.forces = forces_of_boundaries(run.comm, run.mesh, run.model, run.states, friction,
                                       run.options.reference_length, boundaries);
  result.flow.names = flow_names();
  IdVector<NodeId, double> shear;
  if (viscous) {
    result.flow.names.emplace_back(wall_shear_name);
    shear = wall_shear(run.mesh, run.model, friction);
  }
  std::vector<double>& values = result.flow.values;
  for (const NodeId node : run.mesh.owned_ids()) {
    values.insert(values.end(), run.states[node].begin(), run.states[node].end());
    if (viscous) values.push_back(shear[node]);
  }
}

/// Stores the resulting flow of a run: its states or its time averages. *Collective.*
void keep_flow(FlowRun& run, const std::vector<BoundaryEdges>& boundaries, const TimeAverage& average,
               EulerResult& result) {
  if (average.empty()) {
    if (run.model.is_viscous()) run.residual.evaluate(run.states);  // the kept flow may not be the last one
    return take_flow(run, boundaries, run.residual.friction(), result);
  }
  const IdVector<NodeId, State> at_end = run.states;
  average.take(run.states);
  run.residual.evaluate(run.states);
  take_flow(run, boundaries, average.friction(), result);
  std::vector<double> rows;
  for (const State& state : std::span(at_end).first(run.mesh.owned_nodes()))
    rows.insert(rows.end(), state.begin(), state.end());
  append_columns(result.flow, std::vector<std::string>(at_end_names.begin(), at_end_names.end()), rows);
  result.unsteady->cl.mean = result.cl;
  result.unsteady->cd.mean = result.cd;
}

EulerResult march_to_end_time(FlowRun& run, TimeAverage& average) {
  const EulerOptions& options = run.options;
  if (options.time_step && options.end_time / *options.time_step > most_steps_in_time)
    throw InputError(fmt::format(
        "the time {:.6g} in steps of {:.3g} takes more than {:.0f} of them; give a "
        "time_step of {:.3g} or more",
        options.end_time, *options.time_step, most_steps_in_time, options.end_time / most_steps_in_time));
  const progress::SharedStage stage(run.comm, "solving", options.end_time, "units of time");
  EulerResult result;
  march_in_time(run, {options.end_time, options.average_from, options.time_step, options.iterations}, result,
                average);
  return result;
}

EulerResult march_as_steady(FlowRun& run) {
  const progress::SharedStage stage(run.comm, "solving", run.options.iterations, "steps");
  return march_to_steady(run);
}

/// Runs from the run's states to the end specified by the options. *Collective.*
EulerResult march(FlowRun& run, const Field& start, TimeAverage& average) {
  const EulerOptions& options = run.options;
  if (options.time == EulerOptions::Time::accurate) return march_to_end_time(run, average);
  if (options.unsteady == EulerOptions::Unsteady::stop) return march_as_steady(run);
  require_few_steps(run);
  const bool goes_on = goes_on_in_time(options, start);
  EulerResult result;
  if (!goes_on) result = march_as_steady(run);
  if (!result.converged) continue_in_time(run, result, average);
  if (!goes_on || result.failed_in_time.empty()) return result;
  take_start(run.mesh, start, flow_names(), run.states);  // there is no steady flow yet
  run.residual.no_slip().hold(run.states);
  EulerResult steady = march_as_steady(run);
  if (!steady.converged) steady.failed_in_time = result.failed_in_time;
  return steady;
}

/// `mesh` and `start` have the nodes of `dual`. *Collective.*
EulerResult solve_on(const Communicator& comm, const Mesh& mesh, const DualMesh& dual, const FlowModel& model,
                     const EulerOptions& options, const Field& start, const AtEnd& at_end) {
  IdVector<NodeId, State> states = start_states(comm, mesh, dual, model, options, start);
  FlowRun run{
      comm, options, dual, model, Residual(dual, model, options), std::move(states), start.width() > 0};
  run.residual.no_slip().hold(run.states);
  TimeAverage average;
  EulerResult result = march(run, start, average);
  keep_flow(run, mesh.boundaries, average, result);
  if (at_end) at_end(mesh, run, result);
  return result;
}

}  // namespace

EulerResult solve_euler(const Communicator& comm, const Mesh& mesh, const EulerOptions& options,
                        const Field& start, const AtEnd& at_end) {
  validate(options);
  if (mesh.pairs.empty()) {
    const FlowModel model = flow_model(comm, mesh, options);
    return solve_on(comm, mesh, DualMesh(comm, mesh), model, options, start, at_end);
  }
  const PeriodicMesh joined = join_pairs(comm, mesh);
  const FlowModel model = flow_model(comm, joined.mesh, options);
  require_usable_with_pairs(mesh, model, options);
  const DualMesh dual(comm, joined);
  EulerResult result =
      solve_on(comm, joined.mesh, dual, model, options, at_joined_nodes(joined, start), at_end);
  result.flow = at_given_nodes(dual, joined, result.flow);
  return result;
}

}  // namespace quadloop::flow
