#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "adapt/morph/morph_mesh.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/figures.hpp"
#include "app/report/refusals.hpp"
#include "app/report/summary.hpp"
#include "io/files/output_path.hpp"
#include "io/formats.hpp"
#include "io/input/geometry_file.hpp"
#include "io/loaded/interface_nodes.hpp"
#include "io/loaded/tidy_mesh.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "smoother/outline/outline_match.hpp"

namespace quadloop {

namespace {

struct MorphArguments {
  std::string input, output, geometry, from;
};

/// Every rank has the outlines, the root the mesh.
struct MorphInput {
  LoadedMesh whole;
  MeshOrder order;
  std::optional<Geometry> to, from;
};

/// *Collective.*
MorphInput load(const CommandContext& context, const MorphArguments& arguments) {
  MorphInput input;
  Warnings warnings;
  context.comm.together([&] {
    require_readable_suffix(arguments.input);
    require_writable_suffix(arguments.output);
    input.to = read_outline(arguments.geometry, warnings);
    if (!arguments.from.empty()) input.from = read_outline(arguments.from, warnings);
    if (!context.comm.is_root()) return;
    require_possible_output(arguments.output);
    input.whole = read_mesh(arguments.input);
    tidy_mesh(input.whole, arguments.input);
    require_valid_input(input.whole, arguments.input);
    const auto append = [&](const Warnings& more) {
      warnings.insert(warnings.end(), more.begin(), more.end());
    };
    append(input.whole.warnings);
    append(losses_in(input.whole, arguments.output));
    input.order = space_filling_order(input.whole.mesh);
  });
  context.warn(warnings);
  return input;
}

[[noreturn]] void refuse_way(const MorphArguments& arguments, const MorphReport& report) {
  throw InputError(
      fmt::format("{}: its cells cannot follow to {}: near ({:g}, {:g}) some turn over after {:.0f} % of the "
                  "way; go there in "
                  "steps that meshes still follow, or mesh the new outline anew",
                  arguments.input, arguments.geometry, report.worst_place.x, report.worst_place.y,
                  100 * report.possible_way));
}

Figures figures_of(const MorphReport& report) {
  Figures figures;
  figures.add("nodes moved", report.moved);
  figures.add("largest move", report.largest_move, "{:.4g}");
  figures.add("worst quality before", report.worst_before, "{:.3f}");
  figures.add("worst quality after", report.worst_after, "{:.3f}");
  figures.add_raw("smoothed", report.smoothed ? "yes" : "no", report.smoothed ? "true" : "false");
  return figures;
}

void run_morph(const CommandContext& context, const MorphArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  MorphInput input = load(context, arguments);
  Mesh part = scatter_mesh(comm, input.whole.mesh, input.order);
  NodeFlags interfaces;
  if (comm.is_root() && input.whole.blocks > 1) interfaces = interface_nodes(input.whole);
  interfaces = NodeFlags(scatter_nodes(comm, interfaces, input.order));
  times.begin("morph");
  const OutlineChange change{*input.to, arguments.geometry, input.from ? &*input.from : nullptr,
                             arguments.from};
  const MorphReport report = morph_mesh(comm, part, change, interfaces);
  if (!report.valid()) refuse_way(arguments, report);
  gather_mesh(comm, part, input.order, input.whole.mesh);
  comm.together([&] {
    if (comm.is_root()) require_valid(input.whole, arguments.output);
  });
  times.begin("write");
  write_mesh_of_root(comm, input.whole, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  context.record.files = {arguments.output};
  if (!comm.is_root()) return;
  const Figures figures = figures_of(report);
  context.record.figures = figures.record();
  context.record.figures.add("seconds", record_of(stages));
  if (context.shows_table())
    std::cout << figures.table(24) << stage_table(stages) << "  wrote " << arguments.output << "\n";
}

}  // namespace

void add_morph_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<MorphArguments>();
  CLI::App* command = app.add_subcommand("morph", "move a mesh's nodes to a changed outline");
  command->add_option("input", arguments->input, "the mesh (" + suffixes_for({Content::mesh}) + ")")
      ->required()
      ->type_name("IN");
  command
      ->add_option("--geometry", arguments->geometry,
                   "the new outline; boundaries that it lacks stay where they are")
      ->required()
      ->type_name("NEW.geom");
  command
      ->add_option(
          "--from", arguments->from,
          "the outline that IN was made on: where NEW.geom has as many points, nodes stay with their "
          "segments, else they keep their shares of the way between corners")
      ->type_name("OLD.geom");
  command
      ->add_option("-o,--output", arguments->output,
                   "the mesh on the new outline, in the format of its suffix")
      ->required()
      ->type_name("OUT");
  command->callback(
      [&context, arguments] { context.run = [&context, arguments] { run_morph(context, *arguments); }; });
}

}  // namespace quadloop
