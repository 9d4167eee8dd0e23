#include "adapt/loop/flow_solver.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "flow/euler/shortfall.hpp"
#include "flow/euler/solve_euler.hpp"
#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop {

namespace {

/// Where a cycle's mesh stands in any case.
std::string native_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "mesh.mesh").string();
}

SolvedFlow solve(const Communicator& comm, EulerOptions options, const Mesh& mesh,
                 const std::optional<Field>& start, int cycle) {
  SolvedFlow flow;
  options.progress = [&](const EulerProgress& p) {
    flow.notes.push_back(fmt::format("iteration {}: residual {:.3e}, cl {:.6f}, cd {:.6f}", p.iteration,
                                     p.residual, p.cl, p.cd));
  };
  EulerResult result = solve_euler(comm, mesh, options, start.value_or(Field{}));
  if (!result.converged)
    flow.warnings.push_back(fmt::format("cycle {}: {}", cycle, shortfall(result, options)));
  flow.solution = std::move(result.flow);
  flow.solution.constants = {static_cast<double>(result.iterations), result.time, options.mach};
  flow.cl = result.cl;
  flow.cd = result.cd;
  flow.residual = result.residual;
  return flow;
}

/// The mesh in the format that the user's solver reads, and the starting state beside it where that has no
/// place for one. *Collective.*
void write_for(const Communicator& comm, const Mesh& mesh, const std::optional<Field>& start,
               const SolverFiles& files, double gamma) {
  OutputSet outputs(comm);
  const Field* state = start ? &*start : nullptr;
  const bool is_native = files.mesh == native_in(files.folder);
  if (!is_native) write_mesh(outputs, mesh, files.mesh, state);
  if (files.state != files.mesh) write_mesh(outputs, mesh, files.state, state, gamma);
  outputs.commit();
}

SolvedFlow solve(const Communicator& comm, const CommandSolver& solver, const Mesh& mesh,
                 const std::optional<Field>& start, const std::string& folder, int cycle) {
  const std::filesystem::path place = std::filesystem::absolute(folder);
  const int ranks = solver.ranks > 0 ? solver.ranks : comm.size();
  const SolverFiles files{
      place, (place / solver.mesh).string(),   (place / solver.solution).string(), solver.case_folder, ranks,
      cycle, (place / solver.state()).string()};
  write_for(comm, mesh, start, files, solver.gamma);
  run_solver(comm, solver.command, files);
  SolvedFlow flow;
  Field whole;
  MeshOrder order;
  comm.together([&] {
    if (!comm.is_root()) return;
    try {
      LoadedSolution left = read_solution(files.solution);
      const LoadedMesh given = read_native(native_in(files.folder));
      require_same_mesh(left, given.mesh);
      order = own_order(given.mesh);
      whole = std::move(left.solution);
    } catch (const InputError& fault) {
      throw SolverError(solver_message(solver.command, files,
                                       std::string("left no solution for its mesh: ") + fault.what()));
    }
  });
  flow.solution = scatter_field(comm, whole, mesh, order);
  return flow;
}

}  // namespace

std::string CommandSolver::state() const {
  const FileFormat* format = format_of(mesh);
  const bool holds_state = format != nullptr && format->holds(Content::solution);
  return holds_state ? mesh : std::filesystem::path(mesh).replace_extension(".csv").string();
}

double gamma_of(const FlowSolver& solver) {
  if (const auto* options = std::get_if<EulerOptions>(&solver)) return options->gamma;
  return std::get<CommandSolver>(solver).gamma;
}

SolvedFlow solve_flow(const Communicator& comm, const FlowSolver& solver, const Mesh& mesh,
                      const std::optional<Field>& start, const std::string& folder, int cycle) {
  if (const auto* options = std::get_if<EulerOptions>(&solver))
    return solve(comm, *options, mesh, start, cycle);
  return solve(comm, std::get<CommandSolver>(solver), mesh, start, folder, cycle);
}

}  // namespace quadloop
