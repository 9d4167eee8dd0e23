#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/plot/mesh_plot.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"

namespace quadloop {

namespace {

struct PlotArguments {
  std::string input, output, window, field, colouring = "type";
  int size = 1600;
};

PlotFormat picture_format_of(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  if (suffix == ".png") return PlotFormat::png;
  if (suffix == ".svg") return PlotFormat::svg;
  if (suffix == ".pdf") return PlotFormat::pdf;
  throw InputError(path + ": a picture cannot be written in the format '" + suffix +
                   "'; end its name in .png, .svg or .pdf");
}

/// X0,X1,Y0,Y1. Four numbers that span no area are left to draw_mesh.
Box window_of(const std::string& text) {
  std::array<double, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [rest, error] = std::from_chars(at, end, numbers[i]);
    const bool ends_well = i + 1 == numbers.size() ? rest == end : rest != end && *rest == ',';
    if (error != std::errc() || !ends_well || !std::isfinite(numbers[i]))
      throw UsageError("--window takes four numbers X0,X1,Y0,Y1, not '" + text + "'");
    at = rest == end ? end : rest + 1;
  }
  return {{numbers[0], numbers[2]}, {numbers[1], numbers[3]}};
}

PlotOptions options_of(const PlotArguments& arguments) {
  PlotOptions options;
  if (!arguments.window.empty()) options.window = window_of(arguments.window);
  options.field = arguments.field;
  options.size = arguments.size;
  if (arguments.colouring == "rank")
    throw UsageError("--colour-by rank: a mesh file holds no ranks; colour by block, quality or type");
  if (arguments.colouring == "quality") options.colouring = PlotColouring::quality;
  if (arguments.colouring == "block") options.colouring = PlotColouring::block;
  return options;
}

std::string picture(const PlotArguments& arguments, const PlotOptions& options, PlotFormat format) {
  const LoadedMesh loaded = read_mesh(arguments.input);
  try {
    return draw_mesh(loaded, options, format);
  } catch (const InputError& error) {
    throw InputError(arguments.input + ": " + error.what());
  }
}

/// The root rank alone reads and draws; what it cannot do is the same error everywhere.
void run_plot(const CommandContext& context, const PlotArguments& arguments) {
  const Communicator& comm = context.comm;
  PlotOptions options;
  PlotFormat format = PlotFormat::png;
  comm.together([&] {
    require_readable_suffix(arguments.input);
    format = picture_format_of(arguments.output);
    options = options_of(arguments);
  });
  OutputSet outputs(comm);
  const StagedFile staged = outputs.stage(arguments.output);
  comm.together([&] {
    if (!comm.is_root()) return;
    const std::string bytes = picture(arguments, options, format);
    log::detail("writing " + arguments.output);
    OutputFile file(staged);
    file.write(bytes);
    file.close();
  });
  outputs.commit();
  context.record.files = {arguments.output};
}

}  // namespace

void add_plot_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = app.add_subcommand("plot", "draw a mesh, or a field on it");
  command->add_option("input", arguments->input, "the mesh (" + suffixes_for({Content::mesh}) + ")")
      ->required()
      ->type_name("IN");
  command->add_option("-o,--output", arguments->output, "the picture: .png, .svg or .pdf")
      ->required()
      ->type_name("OUT");
  command->add_option("--window", arguments->window, "the part of the plane to show")
      ->type_name("X0,X1,Y0,Y1");
  CLI::Option* field =
      command->add_option("--field", arguments->field, "a variable of the solution, as colours")
          ->type_name("NAME");
  command
      ->add_option("--colour-by,--color-by", arguments->colouring,
                   "what the cells' colours tell: block, quality or type (the default); rank is refused, as "
                   "a mesh file holds no ranks")
      ->type_name("WHAT")
      ->check(one_of({"block", "quality", "type", "rank"}))
      ->excludes(field);
  command->add_option("--size", arguments->size, "pixels along the longer side: 1600")
      ->type_name("N")
      ->check(CLI::Range(400, 20000));
  command->callback(
      [&context, arguments] { context.run = [&context, arguments] { run_plot(context, *arguments); }; });
}

}  // namespace quadloop
