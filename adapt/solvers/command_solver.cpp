#include "adapt/solvers/command_solver.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/mesh/block_runs.hpp"
#include "mesher/mesh/reorder_mesh.hpp"

namespace quadloop::adapt {

namespace {

flow::SolverFiles files_in(const std::string& folder, const CommandSolver& solver, int ranks, int cycle) {
  const std::filesystem::path cycle_folder = std::filesystem::absolute(folder);
  flow::SolverFiles files;
  files.folder = cycle_folder;
  files.mesh = (cycle_folder / solver.mesh).string();
  files.solution = (cycle_folder / solver.solution).string();
  files.case_folder = solver.case_folder;
  files.ranks = solver.ranks > 0 ? solver.ranks : ranks;
  files.cycle = cycle;
  files.state = (cycle_folder / solver.state()).string();
  return files;
}

/// Writes the mesh in the solver's format, and the initial state to a separate file if that format cannot
/// store it. *Collective.*
void write_for(const Communicator& comm, const Mesh& mesh, const Field& start, const flow::SolverFiles& files,
               double gamma) {
  io::OutputSet outputs(comm);
  const Field* state = !start.empty() ? &start : nullptr;
  if (files.mesh != CyclePaths{files.folder}.native_mesh()) io::write_mesh(outputs, mesh, files.mesh, state);
  if (files.state != files.mesh) io::write_mesh(outputs, mesh, files.state, state, gamma);
  outputs.commit();
}

/// Moves a field in even shares of nodes and cells to the ranges that a mesh has. *Collective.*
Field in_ranges_of(const Communicator& comm, const Mesh& mesh, Field even) {
  const auto count = [](const auto& rows, std::size_t width) {
    return static_cast<std::int64_t>(std::size(rows) * width);
  };
  const std::size_t width = even.cells.width();
  even.values = in_ranges(comm, std::move(even.values), mesh.owned_nodes * std::ssize(even.names));
  if (width == 0) return even;
  const EvenShare triangles(comm, comm.sum(std::ssize(mesh.triangles)));
  const auto middle = even.cells.values.begin() + triangles.size() * static_cast<std::int64_t>(width);
  std::vector<double> of_quads(middle, even.cells.values.end());
  even.cells.values.erase(middle, even.cells.values.end());
  even.cells.values = in_ranges(comm, std::move(even.cells.values), count(mesh.triangles, width));
  of_quads = in_ranges(comm, std::move(of_quads), count(mesh.quads, width));
  even.cells.values.insert(even.cells.values.end(), of_quads.begin(), of_quads.end());
  return even;
}

/// Reads the solution of the command, in the order of the mesh. *Collective.*
Field read_left(const Communicator& comm, const Mesh& mesh, const flow::SolverCommand& command,
                const flow::SolverFiles& files) {
  const std::vector<BlockRun> runs = block_runs(comm, mesh);
  try {
    io::LoadedSolution left = io::read_solution(comm, files.solution);
    const io::LoadedMesh given = io::read_mesh(comm, CyclePaths{files.folder}.native_mesh());
    io::require_same_mesh(comm, left, given.mesh);
    if (!runs.empty())
      left.solution =
          ReorderedMesh(comm, given.mesh, order_by_runs(comm, given.mesh, runs)).field(left.solution);
    return in_ranges_of(comm, mesh, std::move(left.solution));
  } catch (const InputError& fault) {
    throw SolverError(
        flow::solver_message(command, files, std::string("left no solution for its mesh: ") + fault.what()));
  }
}

}  // namespace

std::string CommandSolver::state() const {
  const io::FileFormat* format = io::format_of(mesh);
  const bool holds_state = format != nullptr && format->holds(io::Content::solution);
  if (holds_state) return mesh;
  const auto writes_alone = [](const io::FileFormat& row) { return row.write_solution != nullptr; };
  const io::FileFormat* const left = io::format_of(solution);
  const io::FileFormat& alone = left != nullptr && writes_alone(*left)
                                    ? *left
                                    : *std::ranges::find_if(io::file_formats(), writes_alone);
  return std::filesystem::path(mesh).replace_extension(alone.name).string();
}

flow::FlowSolver command_solver(CommandSolver solver, std::function<std::string(int cycle)> folder_of) {
  return [solver = std::move(solver), folder_of = std::move(folder_of)](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    const flow::SolverFiles files = files_in(folder_of(cycle), solver, comm.size(), cycle);
    write_for(comm, mesh, start, files, solver.gamma);
    flow::run_solver(comm, solver.command, files);
    flow::SolvedFlow flow;
    flow.solution = read_left(comm, mesh, solver.command, files);
    return flow;
  };
}

}  // namespace quadloop::adapt
