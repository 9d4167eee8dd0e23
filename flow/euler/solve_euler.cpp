#include "flow/euler/solve_euler.hpp"

#include <algorithm>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/forces.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/progress.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop {

namespace {

using namespace euler;

std::vector<std::string> flow_names() { return {euler_names.begin(), euler_names.end()}; }

/// A state for each node; those of copies come later.
std::vector<State> start_states(const Communicator& comm, const Mesh& mesh, const DualMesh& dual,
                                const FlowModel& model, const EulerOptions& options, const Field& start) {
  std::vector<State> states(dual.nodes(), model.free_stream);
  const std::size_t owned = dual.owned_nodes();
  if (start.width() > 0) {
    const Field given = selected(start, flow_names(), "the starting state");
    QUADLOOP_REQUIRE(given.values.size() == 4 * owned, "a row for each owned node");
    for (std::size_t node = 0; node < owned; ++node)
      std::copy_n(given.values.begin() + 4 * node, 4, states[node].begin());
  } else if (options.initial == EulerOptions::Initial::vortex) {
    const Point centre =
        options.vortex_centre ? *options.vortex_centre : box_over_ranks(comm, mesh.points).centre();
    const Vortex vortex{model.gas, model.free_stream, centre, options.reference_length};
    for (std::int32_t node = 0; node < dual.owned_nodes(); ++node)
      states[node] = vortex.state(dual.point(node), 0);
  }
  return states;
}

/// Flow and forces as they are at the end. *Collective.*
void take_flow(const FlowRun& run, const std::vector<BoundaryEdges>& boundaries, EulerResult& result) {
  const bool viscous = run.model.is_viscous();
  if (viscous) run.residual.evaluate(run.states);  // the flow that is kept may not be the last one
  const std::vector<Point>& friction = run.residual.friction();
  const ForceCoefficients forces =
      wall_forces(run.comm, run.mesh, run.model, run.states, friction, run.options.reference_length);
  result.cl = forces.cl;
  result.cd = forces.cd;
  result.cl_friction = forces.cl_friction;
  result.cd_friction = forces.cd_friction;
  result.forces = forces_of_boundaries(run.comm, run.mesh, run.model, run.states, friction,
                                       run.options.reference_length, boundaries);
  result.flow.names = flow_names();
  std::vector<double> shear;
  if (viscous) {
    result.flow.names.emplace_back(wall_shear_name);
    shear = wall_shear(run.mesh, run.model, friction);
  }
  std::vector<double>& values = result.flow.values;
  for (std::size_t node = 0; node < run.mesh.areas().size(); ++node) {
    values.insert(values.end(), run.states[node].begin(), run.states[node].end());
    if (viscous) values.push_back(shear[node]);
  }
}

}  // namespace

EulerResult solve_euler(const Communicator& comm, const Mesh& mesh, const EulerOptions& options,
                        const Field& start, const AtEnd& at_end) {
  validate(options);
  const FlowModel model = flow_model(comm, mesh, options);
  const DualMesh dual(comm, mesh);
  std::vector<State> states = start_states(comm, mesh, dual, model, options, start);
  Residual residual(dual, model, options);
  residual.no_slip().hold(states);
  const FlowRun run{comm, options, dual, model, residual, states, start.width() > 0};
  const bool steady = options.time == EulerOptions::Time::steady;
  const progress::Stage stage("solving", steady ? options.iterations : options.end_time,
                              steady ? "steps" : "units of time");
  EulerResult result = steady ? march_to_steady(run) : march_in_time(run);
  take_flow(run, mesh.boundaries, result);
  if (at_end) at_end(mesh, run, result);
  return result;
}

}  // namespace quadloop
