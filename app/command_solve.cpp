#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "adapt/loop/record.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/summary.hpp"
#include "flow/adjoint/estimate_goals.hpp"
#include "flow/euler/euler_solver.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/postprocess/flow_quantities.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/reorder_mesh.hpp"
#include "mesher/mesh/variable_names.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop::app {

namespace {

struct SolveArguments {
  std::string case_path, input, output;
  std::vector<std::string> assignments;
};

/// The settings, and the mesh, in the order of its file, with the initial state.
struct SolveProblem {
  Settings settings;
  io::LoadedMesh loaded;
  Field start;  ///< without variables: the initial state follows from the case
};

void require_outputs(const std::string& output) {
  io::require_writable_suffix(output);
  if (!io::format_of(output)->holds(io::Content::solution))
    throw InputError(output + ": this format cannot store the flow; use a " +
                     io::suffixes_for({io::Content::mesh, io::Content::solution}) + " file");
}

/// Returns the initial state if the mesh file has density, velocity and pressure. Throws InputError for
/// values that no flow has.
Field start_of(const io::LoadedMesh& loaded, const std::string& path, Warnings& warnings) {
  if (!loaded.solution || loaded.solution->names.empty()) return {};
  const std::vector<std::string>& names = loaded.solution->names;
  std::vector<std::string> wanted(flow::euler_names.begin(), flow::euler_names.end());
  for (const std::string& name : wanted) {
    if (variables_like(names, name).size() == 1) continue;
    warnings.push_back(fmt::format(
        "{}: its solution has no {}, so the flow starts from the free stream and the solution is replaced",
        path, name));
    return {};
  }
  for (const char* const name : flow::at_end_names) {
    if (std::ranges::find(names, name) != names.end()) wanted.emplace_back(name);
  }
  Field start = selected(*loaded.solution, wanted, path);
  for (std::int32_t node = 0; node < loaded.mesh.owned_nodes; ++node) {
    const auto row = start.row(NodeId{node});
    if (row[0] > 0 && row[3] > 0) continue;
    throw InputError(
        fmt::format("{}: density {} and pressure {} of node {} in its solution must be above 0; remove the "
                    "solution to start from the free stream",
                    path, row[0], row[3], loaded.mesh.first_node + node + 1));
  }
  return start;
}

/// Every rank reads the case, and its share of the mesh. *Collective.*
SolveProblem load(const CommandContext& context, const SolveArguments& arguments) {
  SolveProblem problem;
  context.comm.together([&] {
    io::require_readable_suffix(arguments.input);
    require_outputs(arguments.output);
    problem.settings = read_settings(arguments.case_path, arguments.assignments);
    if (problem.settings.solver.kind != SolverSettings::Kind::euler) {
      throw InputError(arguments.case_path +
                       ": 'solver.kind' is not 'euler', but 'quadloop solve' runs the built-in solver alone; "
                       "set kind = \"euler\"");
    }
    if (context.comm.is_root()) io::require_possible_outputs({arguments.output});
  });
  problem.loaded = io::read_mesh(context.comm, arguments.input);
  context.record.noted = problem.loaded.warnings;
  context.comm.together(
      [&] { problem.start = start_of(problem.loaded, arguments.input, context.record.noted); });
  problem.loaded.solution.reset();
  return problem;
}

/// The tables written with the mesh.
struct TableFiles {
  std::string walls, history;
};

TableFiles tables_beside(const std::string& output) {
  const std::string prefix = std::filesystem::path(output).replace_extension().string();
  return {prefix + flow::wall_table_suffix, prefix + flow::history_suffix};
}

void write_text(io::OutputSet& outputs, const std::string& path, const std::string& text) {
  io::TextOutput file(outputs, path);
  file.write(text);
  file.close();
}

/// Adds the solution to the mesh, in the order of its file, and writes it, with the tables. *Collective.*
void write(const CommandContext& context, SolveProblem& problem, const ReorderedMesh& reordered,
           const Mesh& part, const flow::EulerResult& result, const std::string& path) {
  const Communicator& comm = context.comm;
  const flow::EulerOptions& options = problem.settings.solver.euler;
  const flow::FreeStream stream = flow::free_stream_of(options);
  std::vector<std::string> wall_names;
  for (const flow::BoundaryForce& force : result.forces) wall_names.push_back(force.boundary);
  const std::string walls = flow::wall_table(comm, part, result.flow, stream, wall_names);
  const Field flow =
      flow::with_quantities(flow::flow_with_constants(result, options), problem.settings.fields, stream);
  Field& solution = problem.loaded.solution.emplace(reordered.field_back(flow));
  if (!io::format_of(path)->holds(io::Content::constants)) solution.constants.clear();
  for (std::string& loss : io::losses_in(comm, problem.loaded, path))
    context.record.noted.push_back(std::move(loss));
  io::OutputSet outputs(comm);
  io::write_mesh(outputs, problem.loaded, path);
  write_text(outputs, tables_beside(path).walls, walls);
  write_text(outputs, tables_beside(path).history, flow::history_table(result.history));
  outputs.commit();
}

flow::EulerResult solve(const Communicator& comm, const SolveProblem& problem, const Mesh& part,
                        const Field& start) {
  flow::EulerOptions options = euler_options(problem.settings.solver, problem.settings.outline.rules, part);
  const bool in_time = options.time == flow::EulerOptions::Time::accurate;
  options.progress = [&comm, in_time](const flow::EulerProgress& progress) {
    if (comm.is_root()) log::information(flow::line_of(progress, in_time));
  };
  return flow::solve_euler(comm, part, options, start, flow::estimate_goals(options));
}

Statistics result_statistics(std::int64_t nodes, const flow::EulerResult& result,
                             const flow::EulerOptions& options) {
  Statistics statistics;
  statistics.add("nodes", nodes);
  statistics.add("steps", result.iterations);
  if (options.time == flow::EulerOptions::Time::accurate || result.unsteady)
    statistics.add("time", result.time, "{:.6g}");
  statistics.add("residual", result.residual, "{:.3e}");
  statistics.add("cl", result.cl, "{:.6f}");
  statistics.add("cd", result.cd, "{:.6f}");
  if (options.viscosity > 0) {
    statistics.add("cd pressure", result.cd - result.cd_friction, "{:.6f}");
    statistics.add("cd friction", result.cd_friction, "{:.6f}");
    statistics.add("cl friction", result.cl_friction, "{:.6f}");
  }
  std::string lines;
  for (const flow::GoalValue& goal : result.goals) lines += "  " + adapt::line_of(goal) + "\n";
  for (const flow::BoundaryForce& force : result.forces) {
    const auto& [name, cl, cd, cl_friction, cd_friction] = force;
    lines += fmt::format("  forces on {}: cl {:.6f}, cd {:.6f}", name, cl, cd);
    lines += options.viscosity > 0 ? fmt::format(", cd friction {:.6f}\n", cd_friction) : "\n";
  }
  if (result.unsteady) {
    lines += "  " + flow::line_of(*result.unsteady) + "\n";
    statistics.add_member("unsteady", adapt::record_of(*result.unsteady).text());
  }
  if (!result.goals.empty()) statistics.add_member("goals", adapt::record_of(result.goals).text());
  statistics.add_member("forces", adapt::record_of(result.forces).text());
  statistics.add_lines(lines);
  return statistics;
}

void run_solve(const CommandContext& context, const SolveArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  SolveProblem problem = load(context, arguments);
  const ReorderedMesh reordered(comm, problem.loaded.mesh, order_for_parts(comm, problem.loaded.mesh));
  const Mesh part = reordered.mesh(problem.loaded.mesh);
  const Field start = reordered.field(std::exchange(problem.start, {}));
  times.begin("solve");
  const flow::EulerResult result = solve(comm, problem, part, start);
  times.begin("write");
  write(context, problem, reordered, part, result, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  const std::int64_t nodes = comm.sum(part.owned_nodes);
  if (!comm.is_root()) return;
  context.warn(flow::shortfalls(result, problem.settings.solver.euler));
  const Statistics statistics = result_statistics(nodes, result, problem.settings.solver.euler);
  context.record.statistics = statistics.record();
  context.record.statistics.add("converged", result.converged);
  context.record.statistics.add("seconds", record_of(stages));
  const TableFiles tables = tables_beside(arguments.output);
  context.record.files = io::with_files_beside({arguments.output, tables.walls, tables.history});
  if (context.shows_table())
    std::cout << statistics.table() << stage_table(stages)
              << fmt::format("  wrote {}\n", fmt::join(context.record.files, ", "));
}

}  // namespace

void add_solve_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<SolveArguments>();
  Command command =
      line.add_command("solve", "run the built-in flow solver (2D Euler equations, laminar flow) on a mesh");
  command.add_case_argument(arguments->case_path);
  command
      .add_option(
          "input", arguments->input,
          "the mesh (" + io::read_suffixes_for({io::Content::mesh}) + "); a flow in it is the initial state")
      .required()
      .value_name("IN");
  command
      .add_option(
          "-o,--output", arguments->output,
          "the mesh with the flow (" + io::suffixes_for({io::Content::mesh, io::Content::solution}) + ")")
      .required()
      .value_name("OUT");
  command.add_set_option(arguments->assignments, "solver.mach=0.5");
  command.set_work([&context, arguments] { run_solve(context, *arguments); });
}

}  // namespace quadloop::app
