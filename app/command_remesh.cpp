#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "adapt/remesh/morphed_mesh.hpp"
#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/extent_report.hpp"
#include "app/report/part_report.hpp"
#include "app/report/summary.hpp"
#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/parts/part_output.hpp"
#include "io/solution_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/surely_valid.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/case/case_input.hpp"

namespace quadloop::app {

namespace {

struct RemeshArguments {
  std::string case_path, prefix, tree, mesh, solution, geometry;
  std::vector<std::string> assignments;
  std::optional<double> max_cells;
};

/// Returns possible mesh files of a tree: next to it, with the same name.
std::vector<std::string> files_beside(const std::string& tree) {
  const std::string ending = io::tree_suffix;
  const bool named = tree.size() > ending.size() && tree.ends_with(ending);
  const std::string prefix = named ? tree.substr(0, tree.size() - ending.size()) : tree;
  std::vector<std::string> files;
  for (const std::string& format : io::default_formats()) files.push_back(prefix + "." + format);
  return files;
}

/// Returns the mesh of --mesh. It is accepted as the tree's mesh, with moved nodes, if it has the same counts
/// and valid cells. *Collective.*
io::LoadedMesh named_mesh(const Communicator& comm, const RemeshArguments& arguments,
                          const TreeAttributes& tree) {
  io::LoadedMesh named = io::read_mesh(comm, arguments.mesh);
  adapt::require_counts(count(comm, named.mesh), tree, arguments.mesh, arguments.tree);
  if (is_surely_valid(comm, named.mesh)) return named;
  const Mesh whole = gather_whole(comm, named.mesh);
  comm.together([&] {
    for (const MeshFault& fault : comm.is_root() ? validate(whole) : std::vector<MeshFault>{}) {
      if (fault.rule != MeshRule::indices && fault.rule != MeshRule::positive &&
          fault.rule != MeshRule::coincident)
        continue;
      throw InputError(fmt::format(
          "{}: is not a mesh of this tree: {} at ({}, {}); give the mesh that was written with the tree",
          arguments.mesh, fault.what, fault.place.x, fault.place.y));
    }
  });
  return named;
}

/// Returns the mesh of the solution if the solution's file has another or none: that of --mesh, else the
/// first file next to the tree that is bitwise the tree's mesh. *Collective.*
io::LoadedMesh mesh_of_tree(const Communicator& comm, const RemeshArguments& arguments,
                            const TreeAttributes& tree) {
  if (!arguments.mesh.empty()) return named_mesh(comm, arguments, tree);
  const std::vector<std::string> files = files_beside(arguments.tree);
  for (const std::string& file : files) {
    if (!comm.any(comm.is_root() && std::filesystem::exists(file))) continue;
    try {
      io::LoadedMesh loaded = io::read_mesh(comm, file);
      if (adapt::is_mesh_of_tree(comm, loaded.mesh, tree)) return loaded;
    } catch (const InputError&) {
      continue;  // it was only a guess
    }
  }
  throw InputError(fmt::format(
      "{}: cannot be compared with the mesh of {}, which is not beside it as {}; put it there, or name the "
      "mesh that was solved on with --mesh",
      arguments.solution, arguments.tree, files.front()));
}

/// Returns the mesh of the solution, with the solution. Its nodes are those of the tree: bitwise, or else
/// within 1e-6 of a local edge of those of mesh_of_tree(), which replace them. *Collective.*
io::LoadedMesh solved_mesh(const Communicator& comm, const RemeshArguments& arguments,
                           const TreeAttributes& tree) {
  io::LoadedSolution solution = io::read_solution(comm, arguments.solution);
  if (solution.mesh)
    adapt::require_counts(count(comm, solution.mesh->mesh), tree, arguments.solution, arguments.tree);
  io::LoadedMesh solved;
  if (solution.mesh && adapt::is_mesh_of_tree(comm, solution.mesh->mesh, tree)) {
    solved = std::move(*solution.mesh);
  } else {
    solved = mesh_of_tree(comm, arguments, tree);
    try {
      io::require_same_mesh(comm, solution, solved.mesh);
    } catch (const InputError& fault) {
      if (!arguments.mesh.empty()) throw;
      throw InputError(std::string(fault.what()) + ", or name the mesh that was solved on with --mesh");
    }
    if (solution.mesh) {
      solution.mesh->mesh = std::move(solved.mesh);
      solved = std::move(*solution.mesh);
    }
  }
  solved.solution = std::move(solution.solution);
  return solved;
}

Statistics transfer_statistics(const adapt::RemeshedSolution& remeshed) {
  Statistics statistics;
  statistics.add_raw("nodes outside the old mesh", std::to_string(remeshed.report.outside),
                     json_of(remeshed.report.outside), "outside");
  for (const auto& [name, drift] : remeshed.drifts()) statistics.add("drift of " + name, drift, "{:.3e}");
  return statistics;
}

/// Input of remesh.
struct RemeshProblem {
  TreeRecord tree;
  CaseInput input;
  io::LoadedMesh solved;                ///< in the order of its file
  std::vector<std::string> files;       ///< output files
  std::vector<std::string> part_files;  ///< and those of partitions, if requested
  io::PartRequest parts;
};

/// Writes the outputs; returns the statistics of the partitions, if requested. *Collective.*
std::optional<PartStatistics> write(const Communicator& comm, const adapt::RemeshedSolution& remeshed,
                                    const RemeshProblem& problem) {
  io::OutputSet outputs(comm);
  io::PartFiles part_files(comm);
  std::optional<PartStatistics> parts;
  const MeshResult& result = remeshed.generated.result;
  for (const std::string& file : problem.files) {
    if (file.ends_with(io::tree_suffix))
      io::write_tree(outputs, result.tree, file);
    else
      io::write_mesh(outputs, result.mesh, file, &remeshed.start, problem.input.settings.solver.euler.gamma);
  }
  if (!problem.part_files.empty())
    parts = io::write_parts(part_files, comm, result.mesh, &remeshed.start, problem.parts);
  part_files.commit(outputs);
  return parts;
}

/// *Collective.*
RemeshProblem load(const Communicator& comm, const RemeshArguments& arguments, Warnings& warnings) {
  if (arguments.tree.empty()) {
    throw UsageError(
        "--tree is required: 'quadloop mesh' writes it beside the mesh, as PREFIX.tree.h5; see 'quadloop "
        "remesh --help'");
  }
  RemeshProblem problem;
  problem.tree = io::read_tree(comm, arguments.tree);
  problem.input = load_case(
      comm, {arguments.case_path, arguments.assignments, arguments.geometry, problem.tree.attributes},
      warnings);
  comm.together([&] {
    const Settings& settings = problem.input.settings;
    const std::string prefix = arguments.prefix.empty() ? settings.output_prefix : arguments.prefix;
    for (const std::string& format : settings.formats) problem.files.push_back(prefix + "." + format);
    problem.files.push_back(prefix + io::tree_suffix);
    if (settings.partitions > 0) {
      problem.parts = {prefix, settings.partitions, problem.input.part_formats};
      problem.part_files = io::part_file_names(prefix, settings.partitions, problem.parts.formats);
    }
    io::require_possible_outputs(io::with_files_beside(problem.files));
    io::require_possible_outputs(problem.part_files);
  });
  problem.solved = solved_mesh(comm, arguments, problem.tree.attributes);
  return problem;
}

/// Returns the solved mesh in the order of the tree. *Collective.*
adapt::SolvedMesh in_tree_order(const Communicator& comm, const RemeshArguments& arguments,
                                RemeshProblem& problem) {
  io::LoadedMesh loaded = std::exchange(problem.solved, {});
  adapt::SolvedMesh solved = adapt::in_tree_order(comm, std::move(loaded.mesh),
                                                  loaded.solution.value_or(Field{}), std::move(problem.tree));
  solved.file = arguments.solution;
  adapt::require_own_mesh(comm, solved, arguments.solution, arguments.tree);
  return solved;
}

void report(const CommandContext& context, const adapt::RemeshedSolution& remeshed, const StageTimes& times,
            const RemeshProblem& problem, const std::optional<PartStatistics>& parts) {
  for (const std::string& file : problem.files)
    context.warn(io::changes_in(remeshed.generated.result.mesh, file));
  const std::vector<std::string> files = io::with_files_beside(problem.files);
  MeshSummary summary = summarise(context.comm, remeshed.generated, times.stages(), files);
  if (context.comm.is_root()) add_extents(summary.statistics, problem.input.extents);
  if (parts) add_parts(summary, *parts, problem.part_files);
  Statistics of_transfer = transfer_statistics(remeshed);
  if (remeshed.estimate) of_transfer.add("interpolation error", *remeshed.estimate, "{:.3e}");
  if (remeshed.stretched) {
    of_transfer.add_member("metric", adapt::record_of(*remeshed.stretched).text());
    of_transfer.add_lines(adapt::lines_of(*remeshed.stretched));
  }
  if (problem.input.settings.morph_to)
    of_transfer.add_raw("morphed", remeshed.morphed ? "yes" : "no", remeshed.morphed ? "true" : "false");
  context.record.statistics = record_of(summary);
  context.record.statistics.append(of_transfer.record());
  context.record.files = files;
  context.record.files.insert(context.record.files.end(), problem.part_files.begin(),
                              problem.part_files.end());
  if (context.shows_table()) std::cout << table_of(summary) << of_transfer.table(27, 10);
}

/// Returns the old cells on the changed geometry, if the case requests it and they are good enough; otherwise
/// adds to `doubts` why the mesh is generated again. *Collective.*
std::optional<adapt::RemeshedSolution> morph(const Communicator& comm, const RemeshArguments& arguments,
                                             const RemeshProblem& problem, const adapt::SolvedMesh& solved,
                                             Warnings& doubts) {
  const std::optional<double>& least = problem.input.settings.morph_to;
  if (!least) return {};
  const std::string& file = arguments.geometry.empty() ? arguments.case_path : arguments.geometry;
  const adapt::MorphWish wish{*least, file};
  adapt::MorphedMesh morphed = adapt::morph_solved(comm, *problem.input.mesh, solved, wish);
  if (!morphed.refusal.empty()) doubts.push_back(adapt::why_anew(wish, morphed.refusal));
  return std::move(morphed.remeshed);
}

/// Flags cells by the solution, generates the mesh, and transfers the solution. *Collective.*
adapt::RemeshedSolution remesh(const Communicator& comm, const RemeshProblem& problem,
                               const adapt::SolvedMesh& solved, StageTimes& times, Warnings& warnings) {
  times.begin("adapt");
  const MeshInput& mesh = *problem.input.mesh;
  const std::optional<adapt::AdaptOptions>& adapt = problem.input.settings.adapt;
  const adapt::AdaptationPlan plan =
      adapt ? adapt::plan_adaptation(comm, mesh, *adapt, solved) : adapt::unchanged_plan(solved.tree, mesh);
  times.end();
  adapt::RemeshedSolution remeshed = adapt::remesh_and_transfer(comm, mesh, plan, solved);
  remeshed.estimate = plan.estimate;
  const Warnings& of_mesh = remeshed.generated.result.report.warnings;
  warnings.insert(warnings.end(), of_mesh.begin(), of_mesh.end());
  warnings.insert(warnings.end(), plan.warnings.begin(), plan.warnings.end());
  return remeshed;
}

void run_remesh(const CommandContext& context, const RemeshArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  Warnings& warnings = context.record.noted;
  RemeshProblem problem = load(comm, arguments, warnings);
  times.begin("compare");
  const adapt::SolvedMesh solved = in_tree_order(comm, arguments, problem);
  times.end();
  problem.input.mesh->mesh.limit = mesh_limit(comm, arguments.max_cells);
  std::optional<adapt::RemeshedSolution> remeshed = morph(comm, arguments, problem, solved, warnings);
  if (!remeshed) remeshed = remesh(comm, problem, solved, times, warnings);
  times.append(remeshed->times);
  times.begin("write");
  const std::optional<PartStatistics> parts = write(comm, *remeshed, problem);
  times.end();
  report(context, *remeshed, times, problem, parts);
}

std::string solution_help() {
  std::string with_mesh, alone;
  for (const io::FileFormat& format : io::file_formats()) {
    if (!format.holds(io::Content::solution) || !format.is_read()) continue;
    if (format.holds(io::Content::mesh)) {
      with_mesh += "." + format.name + ", ";
    } else {
      alone += fmt::format("{}.{} ({})", alone.empty() ? "" : ", ", format.name, format.program);
    }
  }
  return "the solution at its nodes: " + with_mesh + "or " + alone + " with the mesh beside the tree";
}

}  // namespace

void add_remesh_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<RemeshArguments>();
  Command command = line.add_command("remesh", "one adaptation step for the solution of any solver");
  command.add_case_argument(arguments->case_path);
  command
      .add_option("--tree", arguments->tree,
                  "quadtree of the mesh of the solution: quadloop mesh writes it beside the mesh")
      .value_name("TREE.h5 REQUIRED");
  command.add_option("--solution", arguments->solution, solution_help()).required().value_name("IN");
  command
      .add_option(
          "--mesh", arguments->mesh,
          "the mesh that was solved on, where it is neither beside the tree nor the tree's own, as after "
          "quadloop smooth")
      .value_name("MESH");
  command.add_option("--geometry", arguments->geometry, "changed geometry, instead of that of the case")
      .value_name("NEW.geom");
  command.add_option("-o,--output", arguments->prefix, "prefix of the output files, instead of output.prefix")
      .value_name("PREFIX");
  command.add_max_cells_option(arguments->max_cells);
  command.add_set_option(arguments->assignments, "adapt.refine=0.5");
  command.set_work([&context, arguments] { run_remesh(context, *arguments); });
}

}  // namespace quadloop::app
