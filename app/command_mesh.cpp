#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "adapt/remesh/demands/restart.hpp"
#include "adapt/remesh/remesh.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/estimate_report.hpp"
#include "app/report/extent_report.hpp"
#include "app/report/part_report.hpp"
#include "app/report/summary.hpp"
#include "generate/mesh_trial.hpp"
#include "io/formats.hpp"
#include "io/input/geom_text.hpp"
#include "io/mesh_file.hpp"
#include "io/parts/part_output.hpp"
#include "io/text/text_output.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/build/islands.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "quadloop/case/case_input.hpp"

namespace quadloop::app {

namespace {

struct MeshArguments {
  std::string case_path, prefix, type, tree, geometry_out;
  std::vector<std::string> assignments;
  std::optional<double> max_cells;
  bool dry_run = false;
};

/// Input known before mesh generation; the same on every rank.
struct Prepared {
  CaseInput input;
  std::vector<std::string> files;       ///< output files, the tree last
  std::vector<std::string> part_files;  ///< and those of partitions, if requested
};

/// Rejects a prefix with a format suffix: `-o out.mesh` would write out.mesh.mesh.
void require_prefix(const std::string& prefix) {
  const std::string suffix = format_suffix_of(prefix);
  if (!suffix.empty())
    throw UsageError("-o " + prefix + ": give the prefix without " + suffix + ", which is added");
}

CaseInput load(const Communicator& comm, const MeshArguments& arguments,
               const std::optional<TreeRecord>& saved, Warnings& warnings) {
  require_prefix(arguments.prefix);
  CaseArguments of_case{arguments.case_path, arguments.assignments, {}, {}};
  if (!arguments.type.empty()) of_case.assignments.push_back("mesh.type=\"" + arguments.type + "\"");
  if (saved) of_case.saved = saved->attributes;
  return load_case(comm, of_case, warnings);
}

Prepared prepare(CaseInput input, const MeshArguments& arguments, Warnings& warnings) {
  Prepared prepared{std::move(input), {}, {}};
  Settings& settings = prepared.input.settings;
  if (!arguments.prefix.empty()) settings.output_prefix = arguments.prefix;
  std::erase_if(settings.formats, [&](const std::string& format) {
    if (io::format_named(format)->holds(io::Content::mesh)) return false;
    warnings.push_back(fmt::format(
        "output.formats: a .{} contains only a solution, which a new mesh does not have; it is not written",
        format));
    return true;
  });
  for (const std::string& format : settings.formats)
    prepared.files.push_back(settings.output_prefix + "." + format);
  prepared.files = io::with_files_beside(prepared.files);
  if (!arguments.geometry_out.empty()) prepared.files.push_back(arguments.geometry_out);
  prepared.files.push_back(settings.output_prefix + io::tree_suffix);
  if (settings.partitions > 0)
    prepared.part_files =
        io::part_file_names(settings.output_prefix, settings.partitions, prepared.input.part_formats);
  io::require_possible_outputs(prepared.files);
  io::require_possible_outputs(prepared.part_files);
  return prepared;
}

/// Returns the geometry as it was meshed, without the dropped islands.
Geometry meshed_geometry(const MeshInput& input) {
  MeshReport reported_already;
  return without_small_islands(input.geometry, input.mesh.size.min, reported_already);
}

void write_geometry(io::OutputSet& outputs, const Geometry& geometry, const std::string& path) {
  io::TextOutput file(outputs, path);
  file.write(file.communicator().is_root() ? io::geom_text(geometry) : "");
  file.close();
}

/// Writes the outputs; returns the statistics of the partitions, if requested.
std::optional<PartStatistics> write_outputs(const Communicator& comm, const MeshResult& result,
                                            const Prepared& prepared, const std::string& geometry_out) {
  io::OutputSet outputs(comm);
  io::PartFiles part_files(comm);
  std::optional<PartStatistics> parts;
  const Settings& settings = prepared.input.settings;
  for (const std::string& format : settings.formats) {
    io::write_mesh(outputs, result.mesh, settings.output_prefix + "." + format);
  }
  if (!geometry_out.empty()) write_geometry(outputs, meshed_geometry(*prepared.input.mesh), geometry_out);
  io::write_tree(outputs, result.tree, settings.output_prefix + io::tree_suffix);
  if (settings.partitions > 0)
    parts = io::write_parts(part_files, comm, result.mesh, nullptr,
                            {settings.output_prefix, settings.partitions, prepared.input.part_formats});
  part_files.commit(outputs);
  return parts;
}

/// SU2 does not report cells for which its scheme is inaccurate. Meshes with layers are not concerned: their
/// other quads change the viscous drag of airfoils by less than 2 %, and quads in layers are better for it
/// than triangles.
Warnings solver_warnings(const Settings& settings, const SolverStatistics& shape, bool layered) {
  constexpr double few = 0.98;  // fraction of quads that are parallelograms
  const auto& formats = settings.formats;
  if (layered || std::find(formats.begin(), formats.end(), "su2") == formats.end() ||
      shape.parallelogram_share() > few)
    return {};
  return {
      fmt::format("{}.su2: {:.0f} % of the quads are not parallelograms, where node-centred solvers such as "
                  "SU2 lose accuracy; mesh.quads = \"parallel\" divides them into triangles",
                  settings.output_prefix, 100 * (1 - shape.parallelogram_share()))};
}

/// Anisotropic cells depend on a solution, which this command does not use. Warns if the saved mesh had
/// metric-based cells; r-adaptation is not recorded in a tree.
Warnings unstretched_warnings(const std::string& tree, const TreeAttributes& saved, const MeshInput& input,
                              const TreeAttributes& made) {
  const char* setting = adapt::setting_that_follows(input);
  const bool same =
      saved.nodes == made.nodes && saved.triangles == made.triangles && saved.quads == made.quads;
  if (!setting || (same && input.mesh.type == MeshType::metric)) return {};
  return {fmt::format(
      "{}: {}: the mesh is that of the quadtree, {} nodes without anisotropic cells{}; \"remesh\" creates "
      "such cells from a solution",
      tree, setting, made.nodes, same ? "" : fmt::format(" where the saved one has {}", saved.nodes))};
}

/// Without a tree this command generates the initial mesh of a case whose cells follow a solution.
Warnings first_mesh_warnings(const MeshInput& input) {
  const char* setting = adapt::setting_that_follows(input);
  if (!setting) return {};
  return {fmt::format(
      "{}: \"mesh\" ignores this setting, which requires a solution, and writes the quadtree mesh from which "
      "\"adapt\" starts",
      setting)};
}

/// Reports the estimated cells, memory and file sizes of a mesh, which is not generated.
void report_estimate(const CommandContext& context, const Prepared& prepared, const MeshEstimate& estimate) {
  const MeshInput& input = *prepared.input.mesh;
  Statistics statistics;
  add_run_estimate(statistics, estimate, context.comm.size());
  const FileSizes sizes(prepared.files, input.mesh.type, estimate);
  sizes.add_to(statistics);
  add_file_sum(statistics, "all files", sizes.sum(), "bytes_of_files");
  if (context.comm.is_root()) add_extents(statistics, prepared.input.extents);
  context.record.statistics = statistics.record();
  if (context.shows_table()) std::cout << statistics.table(24) << "  nothing was written\n";
}

/// Reads, generates the mesh, writes. Warnings are shown at the end, or before an error.
void run_mesh(const CommandContext& context, const MeshArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  std::optional<TreeRecord> saved;
  if (!arguments.tree.empty()) saved = io::read_tree(comm, arguments.tree);
  CaseInput loaded = load(comm, arguments, saved, context.record.noted);
  Prepared prepared;
  comm.together([&] { prepared = prepare(std::move(loaded), arguments, context.record.noted); });
  MeshInput& input = *prepared.input.mesh;
  input.mesh.limit = mesh_limit(comm, arguments.max_cells);
  const DemandedSplits demanded(comm,
                                saved ? adapt::unchanged_splits(*saved, input) : std::vector<SplitDemand>{});
  log::detail("meshing " + std::to_string(input.geometry.size()) + " segments");
  times.end();
  const MeasuredFlow measured = saved ? saved->measured : MeasuredFlow{};
  if (arguments.dry_run) {
    const MeshEstimate estimate = MeshTrial(comm, input, measured).estimate(demanded);
    if (arguments.max_cells) require_within(estimate, input.geometry, input.mesh, demanded);
    return report_estimate(context, prepared, estimate);
  }
  const GeneratedMesh generated = generate_mesh(comm, input, demanded, measured);
  times.append(generated.times);
  times.begin("write");
  log::detail("writing " + prepared.input.settings.output_prefix + ".*");
  const std::optional<PartStatistics> parts =
      write_outputs(comm, generated.result, prepared, arguments.geometry_out);
  times.end();
  context.warn(generated.result.report.warnings);
  context.warn(
      saved ? unstretched_warnings(arguments.tree, saved->attributes, input, generated.result.tree.attributes)
            : first_mesh_warnings(input));
  for (const std::string& file : prepared.files) context.warn(io::changes_in(generated.result.mesh, file));
  MeshSummary summary = summarise(comm, generated, times.stages(), prepared.files);
  if (comm.is_root()) add_extents(summary.statistics, prepared.input.extents);
  if (parts) add_parts(summary, *parts, prepared.part_files);
  context.warn(solver_warnings(prepared.input.settings, summary.shape, has_layers(generated.result.mesh)));
  context.record.statistics = record_of(summary);
  context.record.files = prepared.files;
  context.record.files.insert(context.record.files.end(), prepared.part_files.begin(),
                              prepared.part_files.end());
  if (context.shows_table()) std::cout << table_of(summary);
}

}  // namespace

void add_mesh_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<MeshArguments>();
  Command command = line.add_command("mesh", "generate the mesh of a case file");
  command.add_case_argument(arguments->case_path);
  command.add_option("-o,--output", arguments->prefix, "prefix of the output files, instead of output.prefix")
      .value_name("PREFIX");
  command.add_option("--type", arguments->type, "kind of mesh, instead of mesh.type: hybrid or delaunay")
      .value_name("TYPE")
      .one_of({"hybrid", "delaunay"});
  command
      .add_option("--tree", arguments->tree,
                  "restart from the quadtree of an earlier run: its refinement is kept")
      .value_name("TREE.h5");
  command
      .add_option("--geometry-out", arguments->geometry_out,
                  "write the geometry as meshed, without dropped islands")
      .value_name("OUT.geom");
  command.add_max_cells_option(arguments->max_cells);
  command.add_flag("--dry-run", arguments->dry_run,
                   "report the estimated cells, memory of a rank and file sizes; generate and write nothing");
  command.add_set_option(arguments->assignments, "spacing.min=0.1");
  command.set_work([&context, arguments] { run_mesh(context, *arguments); });
}

}  // namespace quadloop::app
