#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/digests.hpp"
#include "app/settings.hpp"
#include "app/summary.hpp"
#include "io/input/geom_text.hpp"
#include "io/mesh_file.hpp"
#include "io/output_file.hpp"
#include "io/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/timer.hpp"

namespace quadloop {

namespace {

struct MeshArguments {
  std::string case_path, prefix, type, geometry_out;
  std::vector<std::string> assignments;
};

/// What has to be known before the meshing starts; the same on every rank.
struct Prepared {
  Settings settings;
  std::optional<Geometry> geometry;
  MeshOptions options;
  Warnings warnings;
  std::vector<std::string> files;  ///< to be written, the tree last
};

/// A folder that cannot be written to is found out before an hour of meshing.
void require_folder(const std::string& output) {
  std::filesystem::path folder = std::filesystem::path(output).parent_path();
  if (folder.empty()) folder = ".";
  if (!std::filesystem::is_directory(folder)) throw OutputError(output + ": the folder '" + folder.string() + "' does not exist; create it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw OutputError(output + ": the folder '" + folder.string() + "' cannot be written to");
  if (std::filesystem::is_directory(output)) throw OutputError(output + ": is a folder; choose another name");
}

/// An outline in the place of a case file is a likely slip.
void require_case_file(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  for (const char* outline : {".geom", ".dat", ".dxf", ".geojson", ".shp", ".gpkg"}) {
    if (suffix != outline) continue;
    throw InputError(path + ": is an outline, not a case file; write a case file with file = \"" + path + "\" in its table [geometry]");
  }
}

/// `-o out.mesh` would write out.mesh.mesh.
void require_prefix(const std::string& prefix) {
  const std::string suffix = format_suffix_of(prefix);
  if (!suffix.empty()) throw UsageError("-o " + prefix + ": give the prefix without " + suffix + ", which is added");
}

Prepared prepare(const MeshArguments& arguments) {
  require_prefix(arguments.prefix);
  require_case_file(arguments.case_path);
  Prepared prepared;
  std::vector<std::string> assignments = arguments.assignments;
  if (!arguments.type.empty()) assignments.push_back("mesh.type=\"" + arguments.type + "\"");
  Settings& settings = prepared.settings;
  settings = read_settings(arguments.case_path, assignments);
  if (!arguments.prefix.empty()) settings.output_prefix = arguments.prefix;
  for (const std::string& format : settings.formats) prepared.files.push_back(settings.output_prefix + "." + format);
  if (!arguments.geometry_out.empty()) prepared.files.push_back(arguments.geometry_out);
  prepared.files.push_back(settings.output_prefix + ".tree.h5");
  for (const std::string& file : prepared.files) require_folder(file);
  prepared.geometry = load_geometry(settings, prepared.warnings);
  prepared.options = mesh_options(settings, *prepared.geometry);
  for (std::string& warning : spacing_warnings(prepared.options, *prepared.geometry)) prepared.warnings.push_back(std::move(warning));
  return prepared;
}

void write_geometry(OutputSet& outputs, const Geometry& geometry, const std::string& path) {
  const StagedFile staged = outputs.stage(path);
  const Communicator& comm = outputs.communicator();
  comm.together([&] {
    if (!comm.is_root()) return;
    OutputFile file(staged);
    file.write(geom_text(geometry));
    file.close();
  });
}

void write_outputs(const Communicator& comm, const MeshResult& result, const Prepared& prepared, const std::string& geometry_out) {
  OutputSet outputs(comm);
  const Settings& settings = prepared.settings;
  for (const std::string& format : settings.formats) {
    write_mesh(outputs, result.mesh, settings.output_prefix + "." + format);
  }
  if (!geometry_out.empty()) write_geometry(outputs, *prepared.geometry, geometry_out);
  write_tree(outputs, result.tree, settings.output_prefix + ".tree.h5");
  outputs.commit();
}

/// The first few, unless the user asked for all.
void warn(const CommandContext& context, const Warnings& warnings) {
  constexpr std::size_t most_shown = 10;
  if (!context.comm.is_root()) return;
  const std::size_t shown = context.verbose ? warnings.size() : std::min(most_shown, warnings.size());
  for (std::size_t i = 0; i < shown; ++i) log::warning(warnings[i]);
  if (shown < warnings.size()) log::warning(std::to_string(warnings.size() - shown) + " more warnings; --verbose shows them");
}

StageSeconds stages_of(const StageTimes& ours, const StageTimes& of_mesher) {
  StageSeconds seconds;
  for (const auto& stage : ours.stages()) {
    if (stage.first != "mesh")
      seconds.push_back(stage);
    else
      seconds.insert(seconds.end(), of_mesher.stages().begin(), of_mesher.stages().end());
  }
  return seconds;
}

/// The mesh of a Delaunay type ends with flips, under the order of nodes that it was made with.
void smooth(const Communicator& comm, const Prepared& prepared, MeshResult& result) {
  SmoothOptions options = prepared.settings.smooth;
  if (options.sweeps == 0) return;
  options.geometry = &*prepared.geometry;
  const Lattice lattice = choose_root(*prepared.geometry, prepared.options.size.root);
  if (prepared.options.type == MeshType::delaunay) {
    options.delaunay = [&lattice, finest = lattice.finest_level(prepared.options.size.min)](Point p) { return tie_rank(lattice, finest, p); };
  }
  const SmoothReport report = smooth_mesh(comm, result.mesh, options);
  log::detail(fmt::format("smoothed: {} moves of {} nodes in {} sweeps; largest cost {:.4f}, before {:.4f}", report.moves, report.free_nodes,
                          report.sweeps, report.worst_cost_after, report.worst_cost_before));
}

/// Reads on every rank (files are small beside a mesh, and an error is then the same error everywhere), meshes, writes. Warnings
/// come when all is done, so that a failure is one line.
void run_mesh(const CommandContext& context, const MeshArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  Prepared prepared;
  comm.together([&] { prepared = prepare(arguments); });
  log::detail("meshing " + std::to_string(prepared.geometry->size()) + " segments");
  times.begin("mesh");
  MeshResult result = build_mesh(comm, *prepared.geometry, prepared.options);
  times.begin("smooth");
  smooth(comm, prepared, result);
  result.tree.attributes.case_digest = case_digest(prepared.options);
  result.tree.attributes.coordinate_digest = coordinate_digest(comm, result.mesh);
  times.begin("write");
  log::detail("writing " + prepared.settings.output_prefix + ".*");
  write_outputs(comm, result, prepared, arguments.geometry_out);
  times.end();
  warn(context, prepared.warnings);
  warn(context, result.report.warnings);
  const std::string table = summary_table(comm, result, stages_of(times, result.report.times), prepared.files);
  if (!context.quiet) std::cout << table;
}

}  // namespace

void add_mesh_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<MeshArguments>();
  CLI::App* command = app.add_subcommand("mesh", "mesh the domain that a case file describes");
  command->add_option("case", arguments->case_path, "the case file (TOML)")->required()->type_name("CASE.toml");
  command->add_option("-o,--output", arguments->prefix, "what the output files begin with, instead of output.prefix")->type_name("PREFIX");
  command->add_option("--type", arguments->type, "kind of mesh, instead of mesh.type: hybrid or delaunay")
      ->type_name("TYPE")
      ->check(CLI::IsMember({"hybrid", "delaunay"}));
  command->add_option("--geometry-out", arguments->geometry_out, "write the geometry as it is meshed")->type_name("OUT.geom");
  command->add_option("--set", arguments->assignments, "set a key of the case file, as in spacing.min=0.1; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback([&context, arguments] { context.run = [&context, arguments] { run_mesh(context, *arguments); }; });
}

}  // namespace quadloop
