#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/number_list.hpp"
#include "app/report/statistics.hpp"
#include "io/files/output_file.hpp"
#include "io/formats.hpp"
#include "io/input/airfoil_dat.hpp"
#include "io/input/geom_text.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/shapes.hpp"
#include "mesher/geometry/assemble/transform.hpp"

namespace quadloop::app {

namespace {

constexpr int fewest_points = 10, most_points = 100000;

struct AirfoilArguments {
  std::string section, output, hinge, shift;
  int points = NacaAirfoil{}.points;
  double flap = 0, alpha = 0;
  bool blunt = false;
  std::optional<double> far;
};

bool is_dat(const AirfoilArguments& arguments) { return suffix_of(arguments.output) == ".dat"; }

void require_consistent(const AirfoilArguments& arguments) {
  if (!is_dat(arguments) && suffix_of(arguments.output) != ".geom")
    throw UsageError(fmt::format("-o {}: an airfoil is written as .geom or .dat; end the name in one of them",
                                 arguments.output));
  if (is_dat(arguments) && arguments.far)
    throw UsageError(
        "--far: a .dat file holds an airfoil alone; write a .geom file, or set geometry.far_field");
  if (!arguments.hinge.empty() && arguments.flap == 0)
    throw UsageError("--hinge needs --flap, the angle in degrees");
  if (!(std::abs(arguments.flap) <= 90)) throw UsageError("--flap takes an angle from -90 to 90 degrees");
  if (!std::isfinite(arguments.alpha)) throw UsageError("--alpha takes a finite angle in degrees");
}

NacaAirfoil airfoil_of(const AirfoilArguments& arguments) {
  NacaAirfoil airfoil;
  airfoil.code = arguments.section;
  airfoil.sharp = !arguments.blunt;
  airfoil.flap_degrees = arguments.flap;
  airfoil.points = arguments.points;
  if (!arguments.hinge.empty())
    airfoil.hinge =
        number_list(arguments.hinge, ',', 1, 2, "--hinge takes a place on the chord, X, or a point X,Y");
  return airfoil;
}

/// The airfoil, placed, and its far field.
std::vector<Chain> placed_chains(const AirfoilArguments& arguments) {
  std::vector<Chain> chains{naca_chain("airfoil", airfoil_of(arguments), arguments.section)};
  apply({1, -arguments.alpha, {}}, chains);
  constexpr FarFieldShape shape = FarFieldShape::square;
  std::optional<Box> square;
  if (arguments.far) square = far_field_box(chains, shape, *arguments.far, "--far");
  if (!arguments.shift.empty()) {
    const auto shift = number_list(arguments.shift, ',', 2, 2, "--shift takes two numbers DX,DY");
    apply({1, 0, {shift[0], shift[1]}}, chains);
  }
  if (square) add_far_field(chains, shape, *square, "--far");
  return chains;
}

std::string dat_text(const AirfoilArguments& arguments, const Chain& airfoil) {
  std::vector<Point> points(airfoil.points.rbegin(), airfoil.points.rend());
  if (!arguments.blunt) points.insert(points.begin(), points.back());
  return io::airfoil_text(arguments.section, points);
}

Statistics airfoil_statistics(const std::vector<Chain>& chains) {
  const auto& [low, high] = box_of(std::span(chains).first(1));
  Statistics statistics;
  statistics.add("points", std::ssize(chains.front().points));
  statistics.add("width", high.x - low.x, number_pattern);
  statistics.add("height", high.y - low.y, number_pattern);
  return statistics;
}

/// *Collective.*
void run_airfoil(const CommandContext& context, const AirfoilArguments& arguments) {
  require_consistent(arguments);
  io::require_possible_outputs({arguments.output});
  const std::vector<Chain> chains = placed_chains(arguments);
  const std::string text = is_dat(arguments) ? dat_text(arguments, chains.front()) : io::geom_text(chains);
  io::OutputSet outputs(context.comm);
  io::TextOutput file(outputs, arguments.output);
  file.write(text);
  file.close();
  outputs.commit();
  if (!context.comm.is_root()) return;
  const Statistics statistics = airfoil_statistics(chains);
  context.record.statistics = statistics.record();
  context.record.files = {arguments.output};
  if (context.shows_table()) std::cout << statistics.table() << fmt::format("  wrote {}\n", arguments.output);
}

void add_airfoil_options(Command& command, AirfoilArguments& arguments) {
  command
      .add_option("section", arguments.section,
                  "NACA section: naca2412 (four digits), naca0012-64 (modified) or naca23012 (five digits)")
      .required()
      .value_name("SECTION");
  command
      .add_option("-o,--output", arguments.output,
                  "the outline: .geom with curves, or .dat with points in Selig's order")
      .required()
      .value_name("OUT");
  command.add_option("--points", arguments.points, "points on each surface, which splines join (default 201)")
      .value_name("N")
      .between(fewest_points, most_points);
  command.add_flag("--blunt", arguments.blunt, "blunt trailing edge of the original formula");
  command.add_option("--flap", arguments.flap, "angle of a plain flap in degrees, positive: down")
      .value_name("DEG");
  command
      .add_option("--hinge", arguments.hinge,
                  "hinge of the flap: its place on the chord, or its x and y (default 0.75)")
      .value_name("X[,Y]");
  command
      .add_option("--alpha", arguments.alpha,
                  "incidence in degrees: turns the airfoil about its leading edge, nose up")
      .value_name("DEG");
  command.add_option("--far", arguments.far, "adds a square boundary 'farfield' of this half width")
      .value_name("SIZE")
      .positive();
  command.add_option("--shift", arguments.shift, "moves the airfoil, not the far field").value_name("DX,DY");
}

}  // namespace

void add_airfoil_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<AirfoilArguments>();
  Command command = line.add_command("airfoil", "write the outline of a NACA airfoil");
  add_airfoil_options(command, *arguments);
  command.set_work([&context, arguments] { run_airfoil(context, *arguments); });
}

}  // namespace quadloop::app
