#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/figures.hpp"
#include "app/report/refusals.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

struct ConvertArguments {
  std::string input, output, format;
};

void require_format(const ConvertArguments& arguments) {
  const FileFormat* format = format_of(arguments.output);
  if (!arguments.format.empty() || (format != nullptr && format->holds(Content::mesh))) return;
  throw InputError(
      fmt::format("{}: its suffix names none of the formats that meshes are written in; end it in .{}, or "
                  "give --format NAME",
                  arguments.output, fmt::join(formats_for({Content::mesh}), ", .")));
}

Figures figures_of(const LoadedMesh& whole) {
  const auto count = [](const auto& rows) { return std::ssize(rows); };
  Figures figures;
  figures.add("nodes", count(whole.mesh.points));
  figures.add("triangles", count(whole.mesh.triangles));
  figures.add("quads", count(whole.mesh.quads));
  figures.add("blocks", whole.blocks);
  figures.add("boundaries", count(whole.mesh.boundaries));
  figures.add("variables", whole.solution ? count(whole.solution->names) : 0);
  return figures;
}

/// The root rank alone holds the mesh, as the file gives it: nothing is turned, moved or left out but for
/// want of a place. *Collective.*
void run_convert(const CommandContext& context, const ConvertArguments& arguments) {
  const Communicator& comm = context.comm;
  LoadedMesh whole;
  std::vector<std::string> warnings;
  comm.together([&] {
    require_readable_suffix(arguments.input);
    require_format(arguments);
    if (!comm.is_root()) return;
    whole = read_mesh(arguments.input);
    warnings = whole.warnings;
    for (std::string& warning : doubts_about(whole, arguments.input)) warnings.push_back(std::move(warning));
    for (std::string& loss : losses_in(whole, arguments.output, arguments.format))
      warnings.push_back(std::move(loss));
  });
  write_mesh_of_root(comm, whole, arguments.output, arguments.format);
  context.warn(warnings);
  if (!comm.is_root()) return;
  const Figures figures = figures_of(whole);
  context.record.figures = figures.record();
  context.record.files = {arguments.output};
  if (context.shows_table()) std::cout << figures.table() << "  wrote " << arguments.output << "\n";
}

}  // namespace

void add_convert_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand("convert", "write a mesh, as it is, in another format");
  command
      ->add_option("input", arguments->input,
                   "the mesh (" + suffixes_for({Content::mesh}) + "), with a solution where it has one")
      ->required()
      ->type_name("IN");
  command
      ->add_option("output", arguments->output,
                   "the same mesh, in the format of its suffix; IN itself is overwritten")
      ->required()
      ->type_name("OUT");
  command->add_option("--format", arguments->format, "the format to write, whatever OUT ends in")
      ->type_name("NAME")
      ->check(one_of(formats_for({Content::mesh})));
  command->callback(
      [&context, arguments] { context.run = [&context, arguments] { run_convert(context, *arguments); }; });
}

}  // namespace quadloop
