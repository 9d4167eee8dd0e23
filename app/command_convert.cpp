#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/part_output.hpp"
#include "app/report/figures.hpp"
#include "app/report/part_report.hpp"
#include "app/report/refusals.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

struct ConvertArguments {
  std::string input, output, format;
  std::int32_t parts = 0;
};

void require_format(const ConvertArguments& arguments) {
  const FileFormat* format = format_of(arguments.output);
  if (!arguments.format.empty() || (format != nullptr && format->holds(Content::mesh))) return;
  throw InputError(
      fmt::format("{}: its suffix names none of the formats that meshes are written in; end it in .{}, or "
                  "give --format NAME",
                  arguments.output, fmt::join(formats_for({Content::mesh}), ", .")));
}

/// What --parts asks for, known before the mesh is read.
PartRequest part_request(const ConvertArguments& arguments, std::int32_t blocks) {
  const FileFormat* format =
      arguments.format.empty() ? format_of(arguments.output) : format_named(arguments.format);
  PartRequest request{std::filesystem::path(arguments.output).replace_extension().string(), arguments.parts,
                      part_formats({format->name}, blocks)};
  if (request.formats.empty())
    throw InputError(fmt::format(
        "{}: parts are written as .mesh, .vtu or, of one block, .cgns; name one of these", arguments.output));
  return request;
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
  PartFiles part_files(comm);
  std::optional<PartFigures> parts;
  PartRequest request;
  if (arguments.parts > 0) {
    const auto blocks = static_cast<std::int32_t>(comm.maximum(std::int64_t{whole.blocks}));
    request = part_request(arguments, blocks);
    parts = write_parts_of_root(part_files, comm, whole, request);
  }
  write_mesh_of_root(comm, whole, arguments.output, arguments.format);
  part_files.commit();
  context.warn(warnings);
  if (!comm.is_root()) return;
  Figures figures = figures_of(whole);
  context.record.files = {arguments.output};
  std::string wrote = "  wrote " + arguments.output + "\n";
  if (parts) {
    add_parts(figures, *parts);
    for (std::string& file : part_file_names(request.prefix, request.parts, request.formats))
      context.record.files.push_back(std::move(file));
    wrote += fmt::format("  wrote {} and {} files of parts\n", context.record.files[1],
                         context.record.files.size() - 2);
  }
  context.record.figures = figures.record();
  if (context.shows_table()) std::cout << figures.table() << wrote;
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
  command
      ->add_option(
          "--parts", arguments->parts,
          "write the mesh in so many parts as well, for the ranks of a solver: OUT without its suffix "
          "is the prefix of their names")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command->callback(
      [&context, arguments] { context.run = [&context, arguments] { run_convert(context, *arguments); }; });
}

}  // namespace quadloop
