#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/figures.hpp"
#include "app/report/part_report.hpp"
#include "app/report/refusals.hpp"
#include "app/report/solid_report.hpp"
#include "io/foam/foam_plane_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/parts/part_output.hpp"
#include "io/solid_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/solid/plane_of_solid.hpp"

namespace quadloop {

namespace {

struct ConvertArguments {
  std::string input, output, format;
  std::int32_t parts = 0;
};

std::vector<std::string> formats_of_meshes() {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) {
    if (format.holds(Content::mesh) || format.holds(Content::solid)) names.push_back(format.name);
  }
  return names;
}

bool is_of_meshes(const FileFormat* format) {
  return format != nullptr && (format->holds(Content::mesh) || format->holds(Content::solid));
}

const FileFormat& output_format(const ConvertArguments& arguments) {
  const FileFormat* format =
      arguments.format.empty() ? format_of(arguments.output) : format_named(arguments.format);
  if (is_of_meshes(format)) return *format;
  throw InputError(
      fmt::format("{}: its suffix names none of the formats that meshes are written in; end it in .{}, or "
                  "give --format NAME",
                  arguments.output, fmt::join(formats_of_meshes(), ", .")));
}

/// A mesh of two dimensions, or of three.
struct ConvertInput {
  LoadedMesh whole;
  std::optional<SolidMesh> solid;
};

[[noreturn]] void refuse_solid(const ConvertArguments& arguments, const FileFormat& output) {
  throw InputError(fmt::format("{}: holds a 3D mesh, which the format {} has no place for; {} have",
                               arguments.input, output.name, suffixes_for({Content::solid}, "and")));
}

/// A 3D mesh that is one cell thick is a plane one where the output has a place for those.
ConvertInput read_convert_input(const ConvertArguments& arguments) {
  const FileFormat& output = output_format(arguments);
  const FileFormat* const format = format_of(arguments.input);
  if (!is_of_meshes(format)) require_readable_suffix(arguments.input);
  if (format != nullptr && !format->holds(Content::mesh) && !output.holds(Content::solid))
    refuse_solid(arguments, output);
  ConvertInput input;
  input.solid = read_solid(arguments.input);
  if (input.solid && output.holds(Content::mesh) && is_one_cell_thick(*input.solid)) {
    input.whole = loaded_plane(*input.solid, arguments.input);
    input.solid.reset();
  } else if (!input.solid) {
    input.whole = read_mesh(arguments.input);
  }
  if (input.solid && !output.holds(Content::solid)) refuse_solid(arguments, output);
  if (!input.solid && !output.holds(Content::mesh))
    throw InputError(
        fmt::format("{}: holds a plane mesh, and the format {} those of three dimensions alone; "
                    "`quadloop extrude` draws it out",
                    arguments.input, output.name));
  return input;
}

/// What was left out on reading, what is wrong with it, what is lost on writing.
std::vector<std::string> warnings_of(const ConvertInput& input, const ConvertArguments& arguments) {
  std::vector<std::string> warnings = input.solid ? input.solid->warnings : input.whole.warnings;
  const auto append = [&](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  append(input.solid ? doubts_about(*input.solid, arguments.input)
                     : doubts_about(input.whole, arguments.input));
  append(input.solid ? losses_in(*input.solid, arguments.output, arguments.format)
                     : losses_in(input.whole, arguments.output, arguments.format));
  return warnings;
}

Figures figures_of(const SolidMesh& mesh) {
  const auto count = [](const auto& rows) { return std::ssize(rows); };
  Figures figures;
  figures.add("nodes", count(mesh.points));
  figures.add("tetrahedra", count(mesh.tetrahedra));
  figures.add("pyramids", count(mesh.pyramids));
  figures.add("prisms", count(mesh.prisms));
  figures.add("hexahedra", count(mesh.hexahedra));
  if (!mesh.block_names.empty()) figures.add("blocks", count(mesh.block_names));
  figures.add("boundaries", count(mesh.patches));
  figures.add("variables", mesh.solution ? count(mesh.solution->names) : 0);
  return figures;
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
  figures.add("cell variables", whole.solution ? count(whole.solution->cells.names) : 0);
  return figures;
}

/// The root rank alone holds the mesh, as the file gives it: nothing is turned, moved or left out but for
/// want of a place. *Collective.*
/// The parts that have been written, and what was asked for.
struct WrittenParts {
  PartRequest request;
  PartFigures figures;
};

/// *Collective.*
std::optional<WrittenParts> write_parts(const Communicator& comm, const ConvertInput& input,
                                        const ConvertArguments& arguments, PartFiles& files) {
  if (arguments.parts == 0) return std::nullopt;
  if (comm.any(input.solid.has_value()))
    throw InputError(arguments.input + ": holds a 3D mesh; parts are made of plane ones");
  const auto blocks = static_cast<std::int32_t>(comm.maximum(std::int64_t{input.whole.blocks}));
  const PartRequest request = part_request(arguments, blocks);
  return WrittenParts{request, write_parts_of_root(files, comm, input.whole, request)};
}

/// On the root rank alone, whose communicator `outputs` has for itself. *Collective.*
void write_output(const Communicator& comm, const ConvertInput& input, const ConvertArguments& arguments,
                  OutputSet& outputs) {
  comm.together([&] {
    if (!comm.is_root()) return;
    if (input.solid)
      write_solid(outputs, *input.solid, arguments.output, arguments.format);
    else
      write_mesh(outputs, input.whole, arguments.output, arguments.format);
  });
}

/// On the root rank.
void report(const CommandContext& context, const ConvertInput& input, const ConvertArguments& arguments,
            const std::optional<WrittenParts>& parts) {
  Figures figures = input.solid ? figures_of(*input.solid) : figures_of(input.whole);
  std::vector<std::string>& files = context.record.files;
  files = with_files_beside({arguments.output}, arguments.format);
  std::string wrote = fmt::format("  wrote {}\n", fmt::join(files, ", "));
  if (parts) {
    const PartRequest& request = parts->request;
    add_parts(figures, parts->figures);
    const std::vector<std::string> of_parts = part_file_names(request.prefix, request.parts, request.formats);
    files.insert(files.end(), of_parts.begin(), of_parts.end());
    wrote += fmt::format("  wrote {} and {} files of parts\n", of_parts.front(), of_parts.size() - 1);
  }
  context.record.figures = figures.record();
  if (context.shows_table()) std::cout << figures.table() << wrote;
}

void run_convert(const CommandContext& context, const ConvertArguments& arguments) {
  const Communicator& comm = context.comm;
  ConvertInput input;
  comm.together([&] {
    output_format(arguments);
    if (!comm.is_root()) return;
    input = read_convert_input(arguments);
    context.record.noted = warnings_of(input, arguments);
  });
  PartFiles part_files(comm);
  const std::optional<WrittenParts> parts = write_parts(comm, input, arguments, part_files);
  const Communicator alone(MPI_COMM_SELF);
  OutputSet outputs(alone);
  write_output(comm, input, arguments, outputs);
  part_files.commit(outputs);
  if (comm.is_root()) report(context, input, arguments, parts);
}

}  // namespace

void add_convert_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<ConvertArguments>();
  Command command = line.add_command("convert", "write a mesh, as it is, in another format");
  command
      .add_option("input", arguments->input,
                  "the mesh, of two dimensions (" + suffixes_for({Content::mesh}) + ") or three (" +
                      suffixes_for({Content::solid}) + "), with a solution where it has one")
      .required()
      .value_name("IN");
  command
      .add_option("output", arguments->output,
                  "the same mesh, in the format of its suffix; IN itself is overwritten")
      .required()
      .value_name("OUT");
  command.add_option("--format", arguments->format, "the format to write, whatever OUT ends in")
      .value_name("NAME")
      .one_of(formats_of_meshes());
  command
      .add_option(
          "--parts", arguments->parts,
          "write the mesh in so many parts as well, for the ranks of a solver: OUT without its suffix "
          "is the prefix of their names")
      .value_name("N")
      .between(1, 100000);
  command.set_work([&context, arguments] { run_convert(context, *arguments); });
}

}  // namespace quadloop
