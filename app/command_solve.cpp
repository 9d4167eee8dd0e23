#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/command.hpp"
#include "app/report/summary.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/euler/solve_euler.hpp"
#include "io/files/output_path.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

namespace {

struct SolveArguments {
  std::string case_path, input, output;
  std::vector<std::string> assignments;
};

using Row = std::array<double, 4>;  ///< one node's state
const std::vector<std::string> state_names{"density", "x_velocity", "y_velocity", "pressure"};

/// The settings, and on the root rank alone the mesh with the flow to start from.
struct Problem {
  Settings settings;
  LoadedMesh whole;
  MeshOrder order;
  std::vector<Row> start;  ///< of each node; empty: the flow starts as the case says
  Warnings warnings;
};

void require_outputs(const std::string& output) {
  require_writable_suffix(output);
  if (!holds_solution(output))
    throw InputError(output + ": this format has no place for the flow; name a .mesh, .cgns or .vtu file");
}

/// Where a mesh brings density, velocity and pressure along.
std::vector<Row> start_of(const LoadedMesh& whole, const std::string& path, Warnings& warnings) {
  if (!whole.solution || whole.solution->names.empty()) return {};
  const std::vector<std::string>& names = whole.solution->names;
  std::array<std::size_t, 4> columns{};
  for (std::size_t k = 0; k < 4; ++k) {
    columns[k] =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), state_names[k]) - names.begin());
    if (columns[k] < names.size()) continue;
    warnings.push_back(
        fmt::format("{}: its solution has no {}, so the flow starts afresh and its solution is replaced",
                    path, state_names[k]));
    return {};
  }
  std::vector<Row> rows(whole.mesh.points.size());
  for (std::size_t node = 0; node < rows.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k)
      rows[node][k] = whole.solution->values[node * names.size() + columns[k]];
    if (rows[node][0] > 0 && rows[node][3] > 0) continue;
    throw InputError(
        fmt::format("{}: density {} and pressure {} of node {} in its solution must be above 0; take the "
                    "solution out to start afresh",
                    path, rows[node][0], rows[node][3], node + 1));
  }
  return rows;
}

/// Every rank reads the case, the root the mesh. *Collective.*
Problem load(const CommandContext& context, const SolveArguments& arguments) {
  Problem problem;
  context.comm.together([&] {
    require_readable_suffix(arguments.input);
    require_outputs(arguments.output);
    problem.settings = read_settings(arguments.case_path, arguments.assignments);
    if (problem.settings.solver.kind != SolverSettings::Kind::euler) {
      throw InputError(arguments.case_path +
                       ": 'solver.kind' is 'command', but 'quadloop solve' runs the built-in solver alone; "
                       "set kind = \"euler\"");
    }
    if (!context.comm.is_root()) return;
    require_possible_output(arguments.output);
    problem.whole = read_mesh(arguments.input);
    problem.warnings = problem.whole.warnings;
    problem.order = space_filling_order(problem.whole.mesh);
    problem.start = start_of(problem.whole, arguments.input, problem.warnings);
  });
  return problem;
}

std::vector<double> start_states(const Communicator& comm, const Problem& problem) {
  std::vector<double> states;
  for (const Row& row : scatter_nodes(comm, problem.start, problem.order))
    states.insert(states.end(), row.begin(), row.end());
  return states;
}

/// All ranks' states in the order of the whole mesh, on the root. *Collective.*
std::vector<double> gather_states(const Communicator& comm, const std::vector<double>& states,
                                  const MeshOrder& order) {
  const std::vector<double> rows = gather_at_root(comm, states);
  std::vector<double> whole(rows.size());
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i), 4,
                whole.begin() + 4 * std::ptrdiff_t{order.nodes[i / 4]});
  }
  return whole;
}

/// Puts the flow into the whole mesh on the root and writes it. *Collective.*
void write(const Communicator& comm, Problem& problem, const EulerResult& result, const std::string& path) {
  std::vector<double> states = gather_states(comm, result.states, problem.order);
  comm.together([&] {
    if (!comm.is_root()) return;
    const EulerOptions& options = problem.settings.solver.euler;
    Solution solution{{}, state_names, std::move(states)};
    if (std::filesystem::path(path).extension() == ".mesh") {
      solution.constants = {static_cast<double>(result.iterations),
                            result.time,
                            options.mach,
                            options.alpha,
                            result.cl,
                            result.cd,
                            result.residual};
    }
    problem.whole.solution = std::move(solution);
    for (std::string& loss : losses_in(problem.whole, path)) problem.warnings.push_back(std::move(loss));
    const Communicator alone(MPI_COMM_SELF);
    OutputSet outputs(alone);
    write_mesh(outputs, problem.whole, path);
    outputs.commit();
  });
}

EulerResult solve(const Communicator& comm, const Problem& problem, const Mesh& part) {
  EulerOptions options = euler_options(problem.settings.solver, problem.settings.outline.rules, part);
  const bool steady = options.time == EulerOptions::Time::steady;
  options.progress = [&comm, steady](const EulerProgress& p) {
    if (!comm.is_root()) return;
    const std::string time = steady ? "" : fmt::format(", time {:.6g}", p.time);
    log::information(fmt::format("step {}: residual {:.2e}, cl {:.6f}, cd {:.6f}{}", p.iteration, p.residual,
                                 p.cl, p.cd, time));
  };
  return solve_euler(comm, part, options, start_states(comm, problem));
}

Figures result_figures(std::int64_t nodes, const EulerResult& result, const EulerOptions& options) {
  Figures figures;
  figures.add("nodes", nodes);
  figures.add("steps", result.iterations);
  if (options.time == EulerOptions::Time::accurate) figures.add("time", result.time, "{:.6g}");
  figures.add("residual", result.residual, "{:.3e}");
  figures.add("cl", result.cl, "{:.6f}");
  figures.add("cd", result.cd, "{:.6f}");
  return figures;
}

void run_solve(const CommandContext& context, const SolveArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  Problem problem = load(context, arguments);
  const Mesh part = scatter_mesh(comm, problem.whole.mesh, problem.order);
  times.begin("solve");
  const EulerResult result = solve(comm, problem, part);
  times.begin("write");
  write(comm, problem, result, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  const std::int64_t nodes = comm.sum(part.owned_nodes);
  if (!comm.is_root()) return;
  context.warn(problem.warnings);
  if (!result.converged) context.warn({shortfall(result, problem.settings.solver.euler)});
  const Figures figures = result_figures(nodes, result, problem.settings.solver.euler);
  context.record.figures = figures.record();
  context.record.figures.add("converged", result.converged);
  context.record.figures.add("seconds", record_of(stages));
  context.record.files = {arguments.output};
  if (context.shows_table())
    std::cout << figures.table() << stage_table(stages) << "  wrote " << arguments.output << "\n";
}

}  // namespace

void add_solve_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<SolveArguments>();
  CLI::App* command =
      app.add_subcommand("solve", "run the built-in flow solver (2D Euler equations) on a mesh");
  command->add_option("case", arguments->case_path, "the case file (TOML)")
      ->required()
      ->type_name("CASE.toml");
  command
      ->add_option("input", arguments->input,
                   "the mesh (.mesh, .cgns, .vtu, .su2 or .msh); a flow in it is started from")
      ->required()
      ->type_name("IN");
  command->add_option("-o,--output", arguments->output, "the mesh with the flow (.mesh, .cgns or .vtu)")
      ->required()
      ->type_name("OUT");
  command
      ->add_option("--set", arguments->assignments,
                   "set a key of the case file, as in solver.mach=0.5; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback(
      [&context, arguments] { context.run = [&context, arguments] { run_solve(context, *arguments); }; });
}

}  // namespace quadloop
