#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "adapt/own_mesh.hpp"
#include "adapt/remesh.hpp"
#include "app/case_input.hpp"
#include "app/command.hpp"
#include "app/summary.hpp"
#include "io/mesh_file.hpp"
#include "io/output_file.hpp"
#include "io/solution_file.hpp"
#include "io/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/timer.hpp"

namespace quadloop {

namespace {

struct RemeshArguments {
  std::string case_path, prefix, tree, solution, geometry;
  std::vector<std::string> assignments;
};

/// Where the mesh of a tree is: beside it, under the same name.
std::string mesh_beside(const std::string& tree) {
  const std::string ending = ".tree.h5";
  const bool named = tree.size() > ending.size() && tree.ends_with(ending);
  const std::string prefix = named ? tree.substr(0, tree.size() - ending.size()) : tree;
  for (const char* suffix : {".mesh", ".cgns"}) {
    if (std::filesystem::exists(prefix + suffix)) return prefix + suffix;
  }
  throw InputError(tree + ": its mesh is not beside it, but the solution's file has no cells; put it there as " + prefix + ".mesh");
}

/// The solution's own mesh where its file has one, else the tree's. On the calling rank alone.
LoadedMesh solved_mesh(const RemeshArguments& arguments) {
  LoadedSolution solution = read_solution(arguments.solution);
  LoadedMesh whole = read_mesh(solution.has_cells ? arguments.solution : mesh_beside(arguments.tree));
  require_same_mesh(solution, whole.mesh);
  whole.solution = std::move(solution.solution);
  return whole;
}

void write(const Communicator& comm, const CarriedMesh& carried, const std::vector<std::string>& files) {
  OutputSet outputs(comm);
  const MeshResult& result = carried.generated.result;
  for (const std::string& file : files) {
    if (std::filesystem::path(file).extension() == ".h5")
      write_tree(outputs, result.tree, file);
    else
      write_mesh(outputs, result.mesh, file, &carried.start);
  }
  outputs.commit();
}

std::string carried_text(const CarriedMesh& carried) {
  std::string text = fmt::format("  nodes outside the old mesh {:>7}\n", carried.outside);
  for (const auto& [name, drift] : carried.drift) text += fmt::format("  drift of {:<18}{:>10.3e}\n", name, drift);
  return text;
}

void run_remesh(const CommandContext& context, const RemeshArguments& arguments) {
  const Communicator& comm = context.comm;
  if (arguments.tree.empty()) {
    throw UsageError("--tree is required: 'quadloop mesh' writes it beside the mesh, as PREFIX.tree.h5; see 'quadloop remesh --help'");
  }
  StageTimes times;
  times.begin("read");
  TreeRecord tree = read_tree(comm, arguments.tree);
  CaseInput input;
  LoadedMesh whole;
  std::vector<std::string> files;
  comm.together([&] {
    input = load_case({arguments.case_path, arguments.assignments, arguments.geometry, tree.attributes});
    const std::string prefix = arguments.prefix.empty() ? input.settings.output_prefix : arguments.prefix;
    for (const std::string& format : input.settings.formats) files.push_back(prefix + "." + format);
    files.push_back(prefix + ".tree.h5");
    for (const std::string& file : files) require_folder(file);
    if (comm.is_root()) whole = solved_mesh(arguments);
  });
  SolvedMesh solved = spread_solved(comm, whole, std::move(tree));
  solved.file = arguments.solution;
  require_own_mesh(comm, solved, arguments.solution, arguments.tree);
  times.begin("adapt");
  const MeshInput& mesh = *input.mesh;
  const AdaptationPlan plan = input.settings.adapt ? plan_adaptation(comm, mesh, *input.settings.adapt, solved) : standing_plan(solved.tree, mesh);
  times.end();
  const CarriedMesh carried = carry_over(comm, mesh, plan, solved);
  times.append(carried.times);
  times.begin("write");
  write(comm, carried, files);
  times.end();
  show_warnings(comm.is_root(), context.verbose, input.warnings);
  show_warnings(comm.is_root(), context.verbose, carried.generated.result.report.warnings);
  show_warnings(comm.is_root(), context.verbose, plan.warnings);
  for (const std::string& file : files) show_warnings(comm.is_root(), true, renames_in(carried.generated.result.mesh, file));
  const std::string table = summary_table(comm, carried.generated.result, times.stages(), files);
  if (!context.quiet && comm.is_root()) std::cout << table << carried_text(carried);
}

}  // namespace

void add_remesh_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<RemeshArguments>();
  CLI::App* command = app.add_subcommand("remesh", "one pass of the loop for a solution that was computed elsewhere");
  command->add_option("case", arguments->case_path, "the case file (TOML)")->required()->type_name("CASE.toml");
  command->add_option("--tree", arguments->tree, "the tree of the mesh that was solved on: quadloop mesh writes it beside the mesh")
      ->type_name("TREE.h5 REQUIRED");
  command->add_option("--solution", arguments->solution, "the solution at its nodes: .mesh, .cgns, .vtu, or .csv (SU2) with the mesh beside the tree")
      ->required()
      ->type_name("IN");
  command->add_option("--geometry", arguments->geometry, "a changed outline, in the place of the case's")->type_name("NEW.geom");
  command->add_option("-o,--output", arguments->prefix, "what the output files begin with, instead of output.prefix")->type_name("PREFIX");
  command->add_option("--set", arguments->assignments, "set a key of the case file, as in adapt.refine=0.5; one or more")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback([&context, arguments] { context.run = [&context, arguments] { run_remesh(context, *arguments); }; });
}

}  // namespace quadloop
