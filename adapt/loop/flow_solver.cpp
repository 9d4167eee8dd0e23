#include "adapt/loop/flow_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "adapt/remesh/remesh.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/euler/solve_euler.hpp"
#include "io/files/output_file.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

/// Where a cycle's mesh stands in any case.
std::string native_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "mesh.mesh").string();
}

/// The four variables of the built-in solver, row by row; none without a starting state.
std::vector<double> states_of(const std::optional<Solution>& start) {
  std::vector<double> states;
  if (!start) return states;
  const std::size_t width = start->names.size(), rows = start->values.size() / width;
  std::array<std::size_t, 4> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i)
    columns[i] = variable(start->names, euler_names[i], "the starting state");
  for (std::size_t row = 0; row < rows; ++row) {
    for (const std::size_t column : columns) states.push_back(start->values[row * width + column]);
  }
  return states;
}

SolvedFlow solve(const Communicator& comm, EulerOptions options, const Mesh& mesh,
                 const std::optional<Solution>& start, int cycle) {
  SolvedFlow flow;
  options.progress = [&](const EulerProgress& p) {
    flow.notes.push_back(fmt::format("iteration {}: residual {:.3e}, cl {:.6f}, cd {:.6f}", p.iteration,
                                     p.residual, p.cl, p.cd));
  };
  EulerResult result = solve_euler(comm, mesh, options, states_of(start));
  if (!result.converged)
    flow.warnings.push_back(fmt::format("cycle {}: {}", cycle, shortfall(result, options)));
  flow.solution.constants = {static_cast<double>(result.iterations), result.time, options.mach};
  flow.solution.names.assign(euler_names.begin(), euler_names.end());
  flow.solution.values = std::move(result.states);
  flow.cl = result.cl;
  flow.cd = result.cd;
  flow.residual = result.residual;
  return flow;
}

/// The mesh in the format that the user's solver reads, and the starting state beside it where that has no
/// place for one. *Collective.*
void write_for(const Communicator& comm, const Mesh& mesh, const std::optional<Solution>& start,
               const SolverFiles& files, double gamma) {
  OutputSet outputs(comm);
  const Solution* state = start ? &*start : nullptr;
  const bool is_native = files.mesh == native_in(files.folder);
  if (!is_native) write_mesh(outputs, mesh, files.mesh, state);
  if (files.state != files.mesh) write_mesh(outputs, mesh, files.state, state, gamma);
  outputs.commit();
}

/// The rows of this rank's owned nodes from those of all nodes, which the root holds. *Collective.*
std::vector<double> rows_of_owned(const Communicator& comm, const Mesh& mesh, const std::vector<double>& rows,
                                  std::size_t width) {
  const auto counts =
      comm.all_gather(static_cast<std::int64_t>(mesh.owned_nodes) * static_cast<std::int64_t>(width));
  return scatter_from_root(comm, rows, counts);
}

SolvedFlow solve(const Communicator& comm, const CommandSolver& solver, const Mesh& mesh,
                 const std::optional<Solution>& start, const std::string& folder, int cycle) {
  const std::filesystem::path place = std::filesystem::absolute(folder);
  const int ranks = solver.ranks > 0 ? solver.ranks : comm.size();
  const SolverFiles files{
      place, (place / solver.mesh).string(),   (place / solver.solution).string(), solver.case_folder, ranks,
      cycle, (place / solver.state()).string()};
  write_for(comm, mesh, start, files, solver.gamma);
  run_solver(comm, solver.command, files);
  SolvedFlow flow;
  Solution whole;
  comm.together([&] {
    if (!comm.is_root()) return;
    try {
      LoadedSolution left = read_solution(files.solution);
      require_same_mesh(left, read_native(native_in(files.folder)).mesh);
      whole = std::move(left.solution);
    } catch (const InputError& fault) {
      throw SolverError(solver_message(solver.command, files,
                                       std::string("left no solution for its mesh: ") + fault.what()));
    }
  });
  flow.solution = share_solution(comm, whole);
  flow.solution.values = rows_of_owned(comm, mesh, whole.values, flow.solution.names.size());
  return flow;
}

}  // namespace

std::string CommandSolver::state() const {
  return holds_solution(mesh) ? mesh : std::filesystem::path(mesh).replace_extension(".csv").string();
}

double gamma_of(const FlowSolver& solver) {
  if (const auto* options = std::get_if<EulerOptions>(&solver)) return options->gamma;
  return std::get<CommandSolver>(solver).gamma;
}

SolvedFlow solve_flow(const Communicator& comm, const FlowSolver& solver, const Mesh& mesh,
                      const std::optional<Solution>& start, const std::string& folder, int cycle) {
  if (const auto* options = std::get_if<EulerOptions>(&solver))
    return solve(comm, *options, mesh, start, cycle);
  return solve(comm, std::get<CommandSolver>(solver), mesh, start, folder, cycle);
}

}  // namespace quadloop
