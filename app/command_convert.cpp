#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <variant>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/mesh3d_report.hpp"
#include "app/report/part_report.hpp"
#include "app/report/refusals.hpp"
#include "app/report/statistics.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/distribute.hpp"
#include "io/model/plane_of_mesh3d.hpp"
#include "io/model/repeated_rows.hpp"
#include "io/parts/part_output.hpp"
#include "io/stream/block_meshes.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop::app {

using io::Content;

namespace {

struct ConvertArguments {
  std::string input, output, format, block;
  std::int32_t parts = 0;
};

std::vector<std::string> formats_of_meshes() {
  std::vector<std::string> names;
  for (const io::FileFormat& format : io::file_formats()) {
    if (format.holds(Content::mesh) || format.holds(Content::mesh3d)) names.push_back(format.name);
  }
  return names;
}

bool is_of_meshes(const io::FileFormat* format) {
  return format != nullptr && (format->holds(Content::mesh) || format->holds(Content::mesh3d));
}

const io::FileFormat& output_format(const ConvertArguments& arguments) {
  const io::FileFormat* format =
      arguments.format.empty() ? io::format_of(arguments.output) : io::format_named(arguments.format);
  if (is_of_meshes(format)) return *format;
  throw InputError(fmt::format(
      "{}: the suffix is not that of a mesh format that can be written; use .{}, or give --format NAME",
      arguments.output, fmt::join(formats_of_meshes(), ", .")));
}

[[noreturn]] void refuse_mesh3d(const ConvertArguments& arguments, const io::FileFormat& output) {
  throw InputError(fmt::format("{}: contains a 3D mesh, which the format {} cannot store; {} can",
                               arguments.input, output.name, io::suffixes_for({Content::mesh3d}, "and")));
}

/// A 3D mesh that is one cell thick is read as a plane mesh if the output format supports those.
/// *Collective.*
io::MeshOfFile read_convert_input(const Communicator& comm, const ConvertArguments& arguments) {
  const io::FileFormat& output = output_format(arguments);
  const io::FileFormat* const format = io::format_of(arguments.input);
  if (format != nullptr && !format->holds(Content::mesh) && !output.holds(Content::mesh3d))
    refuse_mesh3d(arguments, output);
  io::MeshOfFile mesh = io::read_mesh_file(comm, arguments.input);
  const io::FileMesh* mesh3d = std::get_if<io::FileMesh>(&mesh);  // whole on the root
  const bool thin =
      mesh3d != nullptr && comm.is_root() && output.holds(Content::mesh) && io::is_one_cell_thick(*mesh3d);
  if (comm.any(thin)) return io::plane_of(comm, std::move(mesh), arguments.input);
  if (mesh3d != nullptr && !output.holds(Content::mesh3d)) refuse_mesh3d(arguments, output);
  if (mesh3d == nullptr && !output.holds(Content::mesh))
    throw InputError(fmt::format(
        "{}: contains a 2D mesh, but the format {} stores 3D meshes only; `quadloop extrude` extrudes it",
        arguments.input, output.name));
  return mesh;
}

/// Returns the block that --block names; the mesh is gathered for it. *Collective.*
io::MeshOfFile only_block(const Communicator& comm, io::MeshOfFile input, const ConvertArguments& arguments) {
  if (arguments.block.empty()) return input;
  const auto* plane = std::get_if<io::LoadedMesh>(&input);
  if (plane == nullptr) throw InputError(arguments.input + ": contains a 3D mesh; --block is for 2D meshes");
  const auto found = std::ranges::find(plane->block_names, arguments.block);
  if (found == plane->block_names.end())
    throw InputError(fmt::format("{}: has no block '{}'; its blocks are {}", arguments.input, arguments.block,
                                 io::some_names(plane->block_names)));
  if (plane->blocks == 1) return input;
  io::LoadedMesh whole = io::gathered(comm, *plane);
  comm.together([&] {
    if (comm.is_root())
      whole = io::one_block(whole, static_cast<std::int32_t>(found - plane->block_names.begin()));
  });
  return io::distributed(comm, std::move(whole));
}

/// Return what was omitted on reading, errors of the mesh, and what is lost on writing; of a 3D mesh on the
/// root. *Collective.*
std::vector<std::string> warnings_of(const Communicator&, const io::FileMesh& mesh,
                                     const ConvertArguments& arguments) {
  std::vector<std::string> warnings = mesh.warnings;
  std::ranges::move(doubts_about(mesh, arguments.input), std::back_inserter(warnings));
  std::ranges::move(io::losses_in(mesh, arguments.output, arguments.format), std::back_inserter(warnings));
  return warnings;
}
std::vector<std::string> warnings_of(const Communicator& comm, const io::LoadedMesh& mesh,
                                     const ConvertArguments& arguments) {
  std::vector<std::string> warnings = mesh.warnings;
  std::ranges::move(doubts_about(comm, mesh, arguments.input), std::back_inserter(warnings));
  std::ranges::move(io::losses_in(comm, mesh, arguments.output, arguments.format),
                    std::back_inserter(warnings));
  return warnings;
}

Statistics statistics_of(const Communicator&, const io::FileMesh& mesh) {
  const auto count = [](const auto& rows) { return std::ssize(rows); };
  Statistics statistics;
  statistics.add("nodes", count(mesh.points));
  statistics.add("tetrahedra", count(mesh.tetrahedra));
  statistics.add("pyramids", count(mesh.pyramids));
  statistics.add("prisms", count(mesh.prisms));
  statistics.add("hexahedra", count(mesh.hexahedra));
  if (mesh.has_blocks()) statistics.add("blocks", count(mesh.block_names));
  statistics.add("boundaries", count(mesh.boundaries));
  statistics.add("variables", mesh.solution ? count(mesh.solution->names) : 0);
  return statistics;
}

/// Returns the request of --parts, which is known before the mesh is read.
io::PartRequest part_request(const ConvertArguments& arguments, std::size_t blocks) {
  const io::FileFormat* format =
      arguments.format.empty() ? io::format_of(arguments.output) : io::format_named(arguments.format);
  io::PartRequest request{std::filesystem::path(arguments.output).replace_extension().string(),
                          arguments.parts, io::part_formats({format->name}, blocks)};
  if (request.formats.empty())
    throw InputError(fmt::format(
        "{}: partitions can be written as .mesh, .vtu or, with one block, .cgns; use one of these",
        arguments.output));
  return request;
}

Statistics statistics_of(const Communicator& comm, const io::LoadedMesh& loaded) {
  const auto number = [](const auto& rows) { return std::ssize(rows); };
  const MeshCounts counts = count(comm, loaded.mesh);
  Statistics statistics;
  statistics.add("nodes", counts.nodes);
  statistics.add("triangles", counts.triangles);
  statistics.add("quads", counts.quads);
  statistics.add("blocks", loaded.blocks);
  statistics.add("boundaries", number(loaded.mesh.boundaries));
  statistics.add("variables", loaded.solution ? number(loaded.solution->names) : 0);
  statistics.add("cell variables", loaded.solution ? number(loaded.solution->cells.names) : 0);
  return statistics;
}

/// The parts that have been written, with the request.
struct WrittenParts {
  io::PartRequest request;
  PartStatistics statistics;
};

/// *Collective.*
std::optional<WrittenParts> write_parts(const Communicator& comm, const io::MeshOfFile& input,
                                        const ConvertArguments& arguments, io::PartFiles& files) {
  if (arguments.parts == 0) return std::nullopt;
  const io::LoadedMesh* plane = std::get_if<io::LoadedMesh>(&input);
  if (plane == nullptr)
    throw InputError(arguments.input + ": contains a 3D mesh; only 2D meshes can be partitioned");
  const io::PartRequest request = part_request(arguments, static_cast<std::size_t>(plane->blocks));
  return WrittenParts{request, io::write_parts(files, comm, *plane, request)};
}

/// Writes a plane mesh from all ranks, with its parts. *Collective.*
std::optional<WrittenParts> write_output(const Communicator& comm, const io::LoadedMesh& mesh,
                                         const io::MeshOfFile& input, const ConvertArguments& arguments) {
  io::PartFiles part_files(comm);
  const std::optional<WrittenParts> parts = write_parts(comm, input, arguments, part_files);
  io::OutputSet outputs(comm);
  io::write_mesh(outputs, mesh, arguments.output, arguments.format);
  part_files.commit(outputs);
  return parts;
}

/// Writes a 3D mesh from the root, which has it whole. *Collective.*
std::optional<WrittenParts> write_output(const Communicator& comm, const io::FileMesh& mesh,
                                         const io::MeshOfFile& input, const ConvertArguments& arguments) {
  io::PartFiles part_files(comm);
  write_parts(comm, input, arguments, part_files);
  comm.together([&] {
    if (!comm.is_root()) return;
    const Communicator alone(MPI_COMM_SELF);
    io::OutputSet outputs(alone);
    io::write_mesh(outputs, mesh, arguments.output, arguments.format);
    outputs.commit();
  });
  return std::nullopt;
}

void report(const CommandContext& context, const io::MeshOfFile& input, const ConvertArguments& arguments,
            const std::optional<WrittenParts>& parts) {
  Statistics statistics =
      std::visit([&](const auto& mesh) { return statistics_of(context.comm, mesh); }, input);
  std::vector<std::string>& files = context.record.files;
  files = io::with_files_beside({arguments.output}, arguments.format);
  std::string wrote = fmt::format("  wrote {}\n", fmt::join(files, ", "));
  if (parts) {
    const io::PartRequest& request = parts->request;
    add_parts(statistics, parts->statistics);
    const std::vector<std::string> of_parts =
        io::part_file_names(request.prefix, request.parts, request.formats);
    files.insert(files.end(), of_parts.begin(), of_parts.end());
    wrote += fmt::format("  wrote {} and {}\n", of_parts.front(),
                         counted(std::ssize(of_parts) - 1, "partition file"));
  }
  context.record.statistics = statistics.record();
  if (context.shows_table()) std::cout << statistics.table() << wrote;
}

void run_convert(const CommandContext& context, const ConvertArguments& arguments) {
  const Communicator& comm = context.comm;
  comm.together([&] { output_format(arguments); });
  const io::MeshOfFile input = only_block(comm, read_convert_input(comm, arguments), arguments);
  context.record.noted =
      std::visit([&](const auto& mesh) { return warnings_of(comm, mesh, arguments); }, input);
  const std::optional<WrittenParts> parts =
      std::visit([&](const auto& mesh) { return write_output(comm, mesh, input, arguments); }, input);
  report(context, input, arguments, parts);
}

}  // namespace

void add_convert_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<ConvertArguments>();
  Command command = line.add_command("convert", "write a mesh unchanged in another format");
  command
      .add_option("input", arguments->input,
                  "the mesh: 2D (" + io::read_suffixes_for({Content::mesh}) + ") or 3D (" +
                      io::read_suffixes_for({Content::mesh3d}) + "), with its solution if it has one")
      .required()
      .value_name("IN");
  command
      .add_option("output", arguments->output,
                  "the same mesh, in the format of its suffix; IN itself is overwritten")
      .required()
      .value_name("OUT");
  command.add_option("--format", arguments->format, "format of the output, whatever the suffix of OUT")
      .value_name("NAME")
      .one_of(formats_of_meshes());
  command
      .add_option("--block", arguments->block,
                  "write only this block of a 2D mesh, for solvers that read a file for each")
      .value_name("BLOCK");
  command
      .add_option("--parts", arguments->parts,
                  "also write the mesh in N partitions, for the ranks of a solver: OUT without its suffix is "
                  "the prefix of their names")
      .value_name("N")
      .between(1, 100000);
  command.set_work([&context, arguments] { run_convert(context, *arguments); });
}

}  // namespace quadloop::app
