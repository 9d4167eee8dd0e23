#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/number_list.hpp"
#include "app/plot_tables.hpp"
#include "flow/postprocess/history.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/canvas/flow_charts.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::app {

namespace {

struct PlotArguments {
  std::string input, output, window, field, colouring = "type", range, map = "viridis", shading = "smooth",
                                            lines, size = "1600";
  int contours = 0, streamlines = 0;
  bool walls = false, history = false;
};

enum class Subject { mesh, walls, history };

/// What to plot, and how.
struct PlotTask {
  Subject subject = Subject::mesh;
  io::PlotFormat format = io::PlotFormat::png;
  io::PlotOptions options;
};

/// X0,X1,Y0,Y1. A window without area is rejected by draw_mesh.
Box window_of(const std::string& text) {
  const auto numbers = number_list(text, ',', 4, 4, "--window takes four numbers X0,X1,Y0,Y1");
  return {{numbers[0], numbers[2]}, {numbers[1], numbers[3]}};
}

/// Pixels, or WIDTHxHEIGHT in cm.
void read_size(const std::string& text, io::PlotOptions& options) {
  const std::string refusal =
      "--size takes pixels along the longer side, from 400 to 20000, or WIDTHxHEIGHT in cm, from 5 to 200 "
      "each";
  if (text.find('x') == std::string::npos) {
    const double pixels = number_list(text, ',', 1, 1, refusal)[0];
    if (!(pixels >= 400 && pixels <= 20000 && pixels == std::floor(pixels)))
      throw UsageError(refusal + ", not '" + text + "'");
    options.size = pixels;
    return;
  }
  const std::vector<double> sides = number_list(text, 'x', 2, 2, refusal);
  const auto is_possible = [](double side) { return side >= 5 && side <= 200; };
  if (!std::ranges::all_of(sides, is_possible)) throw UsageError(refusal + ", not '" + text + "'");
  options.centimetres = Point{sides[0], sides[1]};
}

io::PlotOptions options_of(const PlotArguments& arguments) {
  io::PlotOptions options;
  if (!arguments.window.empty()) options.window = window_of(arguments.window);
  options.field = arguments.field;
  read_size(arguments.size, options);
  if (arguments.colouring == "rank")
    throw UsageError("--colour-by rank: a mesh file contains no ranks; use block, quality or type");
  if (arguments.colouring == "quality") options.colouring = io::PlotColouring::quality;
  if (arguments.colouring == "block") options.colouring = io::PlotColouring::block;
  if (!arguments.range.empty()) {
    const std::string refusal = "--range takes two numbers A,B, the first below the second";
    const std::vector<double> range = number_list(arguments.range, ',', 2, 2, refusal);
    options.range = {range[0], range[1]};
    if (!(range[0] < range[1])) throw UsageError(refusal + ", not '" + arguments.range + "'");
  }
  options.map = arguments.map;
  options.smooth = arguments.shading == "smooth";
  if (!arguments.lines.empty()) options.lines = arguments.lines == "on";
  options.contours = arguments.contours;
  options.streamlines = arguments.streamlines;
  return options;
}

Subject subject_of(const PlotArguments& arguments) {
  if (arguments.walls || arguments.input.ends_with(flow::wall_table_suffix)) return Subject::walls;
  if (arguments.history || arguments.input.ends_with(flow::history_suffix)) return Subject::history;
  return Subject::mesh;
}

PlotTask task_of(const PlotArguments& arguments) {
  PlotTask task{subject_of(arguments), io::PlotFormat::png, {}};
  if (task.subject == Subject::mesh) io::require_readable_suffix(arguments.input);
  task.format = io::plot_format_of(arguments.output);
  task.options = options_of(arguments);
  const io::PlotOptions& options = task.options;
  const bool is_of_field = options.range || options.contours > 0 || arguments.shading != "smooth";
  if (task.subject == Subject::mesh && is_of_field && options.field.empty())
    throw UsageError("--range, --contours and --shading require a field; name it with --field");
  return task;
}

/// The bytes on the root, none elsewhere. *Collective.*
std::string picture_of_mesh(const Communicator& comm, const PlotArguments& arguments, const PlotTask& task) {
  io::LoadedMesh loaded = io::read_mesh(comm, arguments.input);
  io::list_inner_curves(loaded);
  loaded.mesh.blocks = {std::move(loaded.block_names), std::move(loaded.triangle_to_block),
                        std::move(loaded.quad_to_block)};
  try {
    return quadloop::picture(comm, std::move(loaded.mesh), loaded.solution.value_or(Field{}), task.options,
                             task.format);
  } catch (const InputError& error) {
    throw InputError(arguments.input + ": " + error.what());
  }
}

std::string chart(const PlotArguments& arguments, const PlotTask& task) {
  const io::PlotOptions& options = task.options;
  if (task.subject == Subject::history)
    return io::draw_chart(chart_of_history(arguments.input), options.size, options.centimetres, task.format);
  const io::PlotTable walls = wall_table_for(arguments.input);
  const std::string column = options.field.empty() ? "Cp" : options.field;
  return io::draw_chart(io::wall_chart(walls, column, options.window), options.size, options.centimetres,
                        task.format);
}

/// A mesh is read by all ranks, a table by the root. *Collective.*
void run_plot(const CommandContext& context, const PlotArguments& arguments) {
  const Communicator& comm = context.comm;
  PlotTask task;
  comm.together([&] { task = task_of(arguments); });
  io::OutputSet outputs(comm);
  const io::StagedFile staged = outputs.stage(arguments.output);
  std::string bytes;
  if (task.subject == Subject::mesh) bytes = picture_of_mesh(comm, arguments, task);
  comm.together([&] {
    if (!comm.is_root()) return;
    if (task.subject != Subject::mesh) bytes = chart(arguments, task);
    log::detail("writing " + arguments.output);
    io::OutputFile file(staged);
    file.write(bytes);
    file.close();
  });
  outputs.commit();
  context.record.files = {arguments.output};
}

void add_field_options(Command& command, PlotArguments& arguments) {
  const Option field = command
                           .add_option("--field", arguments.field,
                                       "variable of the solution, mach or pressure_coefficient, shown by "
                                       "colours; with --walls a column of the table")
                           .value_name("NAME");
  command
      .add_option("--colour-by,--color-by", arguments.colouring,
                  "quantity shown by the cell colours: block, quality or type (the default); rank is "
                  "refused, as mesh files contain no ranks")
      .value_name("WHAT")
      .one_of({"block", "quality", "type", "rank"})
      .excludes(field);
  command.add_option("--range", arguments.range, "range of the colours (default: that of the values shown)")
      .value_name("A,B");
  command.add_option("--map", arguments.map, "colour map of a field: viridis, coolwarm, grey or plasma")
      .value_name("NAME")
      .one_of(io::colour_map_names());
  command
      .add_option("--shading", arguments.shading,
                  "shading of a field: smooth (linear over triangles, bilinear over quads) or flat")
      .value_name("HOW")
      .one_of({"smooth", "flat"});
  command.add_option("--lines", arguments.lines, "mesh lines, on or off (default: off if a field is shown)")
      .value_name("on|off")
      .one_of({"on", "off"});
  command.add_option("--contours", arguments.contours, "number of contour lines (default: 0)")
      .value_name("N")
      .between(0, 1000);
  command
      .add_option("--streamlines", arguments.streamlines,
                  "approximate number of streamlines across the shorter side (default: 0)")
      .value_name("N")
      .between(0, 200);
}

void add_chart_options(Command& command, PlotArguments& arguments) {
  const Option walls = command.add_flag("--walls", arguments.walls,
                                        "Cp over x along the walls, from the table .walls.csv beside IN, or "
                                        "from the last cycle if IN is the folder of an adaptive run");
  command
      .add_flag("--history", arguments.history,
                "residual and forces over steps, from the table .history.csv beside IN, or from all cycles "
                "if IN is the folder of an adaptive run; over cycles if the solver writes no such table")
      .excludes(walls);
}

}  // namespace

void add_plot_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<PlotArguments>();
  Command command = line.add_command("plot", "plot a mesh, a field, the flow along walls, or a history");
  command
      .add_option("input", arguments->input,
                  "the mesh (" + io::read_suffixes_for({io::Content::mesh}) +
                      "); or a table .walls.csv or .history.csv")
      .required()
      .value_name("IN");
  command.add_option("-o,--output", arguments->output, "the picture: .png, .svg or .pdf")
      .required()
      .value_name("OUT");
  command.add_option("--window", arguments->window, "the part of the plane, or of the axes, to show")
      .value_name("X0,X1,Y0,Y1");
  command
      .add_option("--size", arguments->size,
                  "pixels along the longer side, 1600, or width and height in cm: 16x10")
      .value_name("N|WxH");
  add_field_options(command, *arguments);
  add_chart_options(command, *arguments);
  command.set_work([&context, arguments] { run_plot(context, *arguments); });
}

}  // namespace quadloop::app
