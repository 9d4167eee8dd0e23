#include "flow/adjoint/estimate_goals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "flow/adjoint/goal_error.hpp"
#include "flow/adjoint/parameter_derivative.hpp"
#include "flow/adjoint/place_derivative.hpp"
#include "flow/adjoint/solve_adjoint.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/progress.hpp"

namespace quadloop::flow {

namespace {

using namespace euler;

constexpr std::array<const char*, 4> conserved{"mass", "x_momentum", "y_momentum", "energy"};

std::string name_of(Goal::Quantity quantity) {
  for (const auto& [word, value] : Goal::words) {
    if (value == quantity) return word;
  }
  QUADLOOP_REQUIRE(false, "a goal without a word");
  return {};
}

void append_adjoint(const std::string& goal, const Adjoint& adjoint, Field& flow) {
  std::vector<std::string> names;
  for (const char* const name : conserved) names.push_back(fmt::format("{}_adjoint_{}", goal, name));
  std::vector<double> values;
  const std::size_t rows = flow.values.size() / flow.width();
  for (const Flux& row : std::span(adjoint.weights).first(rows))
    values.insert(values.end(), row.begin(), row.end());
  append_columns(flow, names, values);
}

void append_places(const std::string& goal, const IdVector<NodeId, Point>& derivative, Field& flow) {
  std::vector<double> values;
  for (const Point& of_node : derivative) values.insert(values.end(), {of_node.x, of_node.y});
  append_columns(flow, std::vector{goal + "_by_x", goal + "_by_y"}, values);
}

void refuse(const EulerOptions& options) {
  if (options.time != EulerOptions::Time::steady)
    throw InputError("solver.goal requires a steady flow; set solver.time = \"steady\", or remove the goal");
  if (options.far_field == EulerOptions::FarField::vortex)
    throw InputError(
        "solver.goal requires the free stream at the far field; set solver.far_field = \"uniform\", or "
        "remove the goal");
  if (options.viscosity > 0)
    throw InputError(
        "solver.goal requires an inviscid flow; remove solver.viscosity and solver.reynolds, or the goal");
}

void estimate(const Mesh& mesh, FlowRun& run, EulerResult& result) {
  std::vector<std::string> boundaries;
  for (const BoundaryEdges& boundary : mesh.boundaries) boundaries.push_back(boundary.name);
  const LinearResidual linear(run);
  IdVector<NodeId, double> error(run.mesh.owned_nodes(), 0.0);
  for (const Goal& goal : run.options.goals) {
    const GoalFunctional functional(run.comm, run.mesh, run.model, boundaries, goal,
                                    run.options.reference_length);
    const Adjoint adjoint = solve_adjoint(linear, functional.derivative());
    const GoalError found = goal_error(run, functional, adjoint.weights);
    const auto [by_alpha, by_mach] = parameter_derivative(run, boundaries, goal, adjoint.weights);
    const double value = functional.value(run.states);
    result.goals.push_back({name_of(goal.quantity), value, value - found.signed_sum, found.sum, by_alpha,
                            by_mach, adjoint.iterations, adjoint.residual, adjoint.converged});
    for (const NodeId node : error.ids()) error[node] += goal.weight * found.of_nodes[node];
    if (!run.options.adjoint_fields) continue;
    append_adjoint(name_of(goal.quantity), adjoint, result.flow);
    append_places(name_of(goal.quantity), place_derivative(linear, functional, adjoint.weights), result.flow);
  }
  append_columns(result.flow, std::vector<std::string>{error_name}, error);
}

}  // namespace

AtEnd estimate_goals(const EulerOptions& options) {
  if (options.goals.empty()) return {};
  refuse(options);
  return estimate;
}

}  // namespace quadloop::flow
