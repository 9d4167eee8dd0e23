#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/refusals.hpp"
#include "app/report/statistics.hpp"
#include "io/files/output_path.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/plane_of_mesh3d.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "quadloop/quadloop.hpp"
#include "quadloop/require_input.hpp"

namespace quadloop::app {

namespace {

constexpr std::int64_t most_layers = 1000000;

struct ExtrudeArguments {
  std::string input, output, heights, axis = "z";
  std::int64_t layers = 0;
  double thickness = 0;
  std::optional<double> max_cells;
};

/// Reads numbers from a text file with "#" comments: the coordinates of the levels, ascending.
std::vector<double> read_heights(const std::string& path) {
  io::TextScanner scan(path);
  std::vector<double> heights;
  while (!scan.at_end()) {
    const double height = scan.real("the height of a level");
    if (!heights.empty() && !(height > heights.back()))
      scan.refuse(
          fmt::format("the level at {} does not lie above the one before it, at {}", height, heights.back()));
    heights.push_back(height);
  }
  if (heights.size() < 2)
    scan.refuse(fmt::format("{} heights; extrusion needs two levels or more", heights.size()));
  return heights;
}

/// Checks the consistency of the command line options.
void require_one_way(const ExtrudeArguments& arguments) {
  const bool even = arguments.layers > 0 || arguments.thickness > 0;
  if (even == !arguments.heights.empty())
    throw UsageError("extrude requires either --layers N and --thickness T, or --heights FILE");
  if (even && (arguments.layers == 0 || arguments.thickness == 0))
    throw UsageError("extrude requires both --layers N and --thickness T, the total thickness of the layers");
}

/// Returns the heights, the same on every rank. *Collective.*
std::vector<double> heights_of(const Communicator& comm, const ExtrudeArguments& arguments) {
  std::vector<double> heights;
  if (arguments.heights.empty()) {
    heights = io::even_heights(arguments.layers, arguments.thickness);
    if (std::ranges::adjacent_find(heights, std::ranges::greater_equal()) != heights.end())
      throw UsageError(
          fmt::format("--thickness {} is too small for {} layers", arguments.thickness, arguments.layers));
    require_heights(heights, "--thickness");
    return heights;
  }
  comm.together([&] {
    if (!comm.is_root()) return;
    heights = read_heights(arguments.heights);
    require_heights(heights, arguments.heights);
  });
  comm.broadcast(heights);
  return heights;
}

/// The plane mesh with its blocks, distributed in the order of its file, and its solution.
struct Plane {
  Mesh mesh;
  Field solution;
};

/// Returns the mesh without its inner boundaries. *Collective.*
Plane load(const CommandContext& context, const ExtrudeArguments& arguments,
           std::vector<std::string>& warnings) {
  const Communicator& comm = context.comm;
  comm.together([&] {
    io::require_readable_suffix(arguments.input);
    io::require_mesh3d_suffix(arguments.output);
  });
  io::MeshOfFile input = io::read_mesh_file(comm, arguments.input);
  comm.together([&] {
    const io::FileMesh* mesh3d = std::get_if<io::FileMesh>(&input);
    if (comm.is_root() && mesh3d != nullptr && !io::is_one_cell_thick(*mesh3d))
      throw InputError(arguments.input + ": is a 3D mesh already; give a 2D mesh");
  });
  io::LoadedMesh loaded = io::plane_of(comm, std::move(input), arguments.input);
  require_valid_input(comm, loaded, arguments.input);
  warnings = loaded.warnings;
  for (std::string& loss : io::drop_interfaces(comm, loaded, arguments.output))
    warnings.push_back(std::move(loss));
  io::list_inner_curves(loaded);
  if (loaded.blocks > 1) loaded.mesh.blocks = io::plane_blocks(loaded);
  return {std::move(loaded.mesh), loaded.solution.value_or(Field{})};
}

/// Least file size: the numbers of nodes and cells in the most compact formats.
double least_bytes(const io::ExtrudedCounts& counts) {
  constexpr double of_node = 24, of_prism = 6 * 4, of_hexahedron = 8 * 4;
  return of_node * static_cast<double>(counts.nodes) + of_prism * static_cast<double>(counts.prisms) +
         of_hexahedron * static_cast<double>(counts.hexahedra);
}

/// Reports the size of a large mesh before it is written. Throws if it has more cells than allowed, or does
/// not fit on the disk. Memory is not a limit, as no rank stores the mesh. *Collective.*
void require_room(const Communicator& comm, const io::ExtrudedCounts& counts,
                  const ExtrudeArguments& arguments) {
  constexpr double large = 1e6;
  const auto cells = static_cast<double>(counts.cells());
  const double bytes = least_bytes(counts);
  comm.together([&] {
    if (!comm.is_root()) return;
    std::error_code unknown;
    const auto disk = std::filesystem::space(io::folder_of(arguments.output), unknown);
    const double free = unknown ? MeshLimit::none : static_cast<double>(disk.available);
    const bool allowed = arguments.max_cells ? cells <= *arguments.max_cells : bytes <= free;
    if (!allowed) {
      const std::string limit = arguments.max_cells
                                    ? fmt::format("--max-cells allows {:.0f}", *arguments.max_cells)
                                    : fmt::format("{} are free there", text_of_bytes(free));
      throw TooManyCells(fmt::format(
          "{}: would have {} cells in {} layers and need at least {} on the disk, but {}; use fewer layers, "
          "or {} --max-cells {:.0f}",
          arguments.output, text_of_cells(cells), counts.cells() / (counts.triangles + counts.quads),
          text_of_bytes(bytes), limit, arguments.max_cells ? "allow more with" : "override with", cells));
    }
    const std::string text =
        fmt::format("{} cells, at least {} on the disk", text_of_cells(cells), text_of_bytes(bytes));
    if (cells >= large)
      log::information(text);
    else
      log::detail(text);
  });
}

Statistics statistics_of(const io::ExtrudedCounts& counts, const std::vector<double>& heights, double area) {
  const double height = heights.back() - heights.front();
  Statistics statistics;
  statistics.add("nodes", counts.nodes);
  statistics.add("prisms", counts.prisms);
  statistics.add("hexahedra", counts.hexahedra);
  statistics.add("layers", std::ssize(heights) - 1);
  statistics.add("height", height, "{:.6g}");
  statistics.add("volume", area * height, "{:.6g}");
  return statistics;
}

/// *Collective.*
void run_extrude(const CommandContext& context, const ExtrudeArguments& arguments) {
  const Communicator& comm = context.comm;
  require_one_way(arguments);
  std::vector<std::string>& warnings = context.record.noted;
  const std::vector<double> heights = heights_of(comm, arguments);
  Plane plane = load(context, arguments, warnings);
  const double area = reproducible_sum(comm, cell_areas(plane.mesh));
  const ExtrusionAxis axis = arguments.axis == "y" ? ExtrusionAxis::y : ExtrusionAxis::z;
  const io::ExtrudedCounts counts(comm, io::extruded(plane.mesh, heights, axis));
  require_room(comm, counts, arguments);
  for (std::string& loss :
       extrude(comm, std::move(plane.mesh), heights, arguments.output, plane.solution, axis))
    warnings.push_back(std::move(loss));
  if (!comm.is_root()) return;
  const Statistics statistics = statistics_of(counts, heights, area);
  context.record.statistics = statistics.record();
  context.record.files = io::with_files_beside({arguments.output});
  if (context.shows_table())
    std::cout << statistics.table() << fmt::format("  wrote {}\n", fmt::join(context.record.files, ", "));
}

void add_options(Command& command, ExtrudeArguments& arguments) {
  command
      .add_option("input", arguments.input, "the mesh (" + io::read_suffixes_for({io::Content::mesh}) + ")")
      .required()
      .value_name("IN");
  command
      .add_option("-o,--output", arguments.output,
                  "the 3D mesh, in the format of its suffix (" + io::suffixes_for({io::Content::mesh3d}) +
                      ", a folder)")
      .required()
      .value_name("OUT");
  command.add_option("--layers", arguments.layers, "number of cell layers, of equal thickness")
      .value_name("N")
      .between(1, most_layers);
  command.add_option("--thickness", arguments.thickness, "total thickness of the layers")
      .value_name("T")
      .positive();
  command
      .add_option("--heights", arguments.heights,
                  "instead: file with the coordinates of the levels along the axis, two or more, ascending")
      .value_name("FILE");
  command
      .add_option("--axis", arguments.axis,
                  "axis of extrusion: z (the default), or y: the y of the 2D mesh becomes z")
      .value_name("AXIS")
      .one_of({"y", "z"});
  command
      .add_option("--max-cells", arguments.max_cells,
                  "largest number of cells (default: limited by the free disk space)")
      .value_name("N")
      .positive();
}

}  // namespace

void add_extrude_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<ExtrudeArguments>();
  Command command = line.add_command("extrude", "extrude a mesh to prisms and hexahedra, with its solution");
  add_options(command, *arguments);
  command.set_work([&context, arguments] { run_extrude(context, *arguments); });
}

}  // namespace quadloop::app
