#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "adapt/morph/morph_derivative.hpp"
#include "adapt/morph/morph_mesh.hpp"
#include "adapt/morph/outline_pieces.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/refusals.hpp"
#include "app/report/statistics.hpp"
#include "app/report/summary.hpp"
#include "io/formats.hpp"
#include "io/input/geometry_file.hpp"
#include "io/input/point_table.hpp"
#include "io/mesh_file.hpp"
#include "io/model/interface_nodes.hpp"
#include "io/model/tidy_mesh.hpp"
#include "io/solution_file.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/point_table.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "smoother/outline/outline_match.hpp"

namespace quadloop::app {

namespace {

struct MorphArguments {
  std::string input, output, geometry, from;
  std::string direction;                              ///< table with the velocities of the geometry's points
  std::string nodal_gradient, outline_gradient;       ///< a solution, and the table computed from it
  std::vector<std::string> fields{"dJ_dx", "dJ_dy"};  ///< of that solution

  bool wants_derivative() const { return !direction.empty() || !outline_gradient.empty(); }
};

/// The fields added to OUT for a direction.
const std::vector<std::string> velocity_names{"dx_ds", "dy_ds"};

/// Input: the geometries on every rank, the mesh on the root.
struct MorphInput {
  io::LoadedMesh whole;
  MeshOrder order;
  std::optional<Geometry> to, from;
  bool by_pieces = false;        ///< these are OutlinePieces
  std::vector<Point> direction;  ///< for each point of `to`
};

void require_outputs(const MorphArguments& arguments) {
  if (arguments.nodal_gradient.empty() != arguments.outline_gradient.empty())
    throw UsageError(
        "--nodal-gradient and --outline-gradient require each other: the first is read, the second is "
        "written");
  if (arguments.fields.front() == arguments.fields.back())
    throw UsageError("--fields: '" + arguments.fields.front() +
                     "' is named twice; name the fields of dJ/dx and of dJ/dy");
  if (arguments.output.empty() && (arguments.outline_gradient.empty() || !arguments.direction.empty()))
    throw UsageError("-o is required: the mesh on the new geometry; see 'quadloop morph --help'");
  if (arguments.direction.empty()) return;
  io::require_writable_suffix(arguments.output);
  if (!io::format_of(arguments.output)->holds(io::Content::solution))
    throw InputError(arguments.output + ": this format cannot store the nodal velocities; use a " +
                     io::suffixes_for({io::Content::mesh, io::Content::solution}) + " file");
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code none;  // one of them may not exist
  return a == b || std::filesystem::equivalent(a, b, none);
}

/// Requires that the outputs can be written and do not overwrite inputs or each other. Only the mesh may be
/// replaced by its successor.
void require_other_outputs(const MorphArguments& arguments) {
  const std::string &mesh = arguments.output, &table = arguments.outline_gradient;
  const auto require_other = [](const std::string& output, const std::string& other) {
    if (!output.empty() && !other.empty() && is_same_file(output, other))
      throw UsageError(output + ": is " + (output == other ? "" : other + ", ") +
                       "used for two files, one of which would be overwritten; give the output another name");
  };
  for (const std::string& output : {mesh, table}) {
    if (!output.empty()) io::require_possible_outputs({output});
    for (const std::string& input :
         {arguments.geometry, arguments.from, arguments.direction, arguments.nodal_gradient})
      require_other(output, input);
  }
  require_other(table, arguments.input);
  require_other(table, mesh);
}

/// Reads both geometries piece by piece if the boundaries and inner lines of the mesh are no closed loops,
/// else as outlines.
void read_geometries(const MorphArguments& arguments, bool closed, MorphInput& input, Warnings& warnings) {
  if (!closed && !arguments.from.empty()) {
    Warnings told_already;
    std::optional<adapt::OutlinePieces> pieces = adapt::pieces_of(
        io::read_geometry(arguments.from, warnings), io::read_geometry(arguments.geometry, told_already));
    if (!pieces)
      throw InputError(fmt::format(
          "{}: its pieces are not those of {}, with the same names and numbers of points in the "
          "same order, as a mesh with inner lines, or with blocks that touch its boundary, requires",
          arguments.geometry, arguments.from));
    input.by_pieces = true;
    input.to = std::move(pieces->to);
    input.from = std::move(pieces->from);
    return;
  }
  try {
    input.to = io::read_outline(arguments.geometry, warnings);
  } catch (const InputError& fault) {
    if (closed) throw;
    throw InputError(std::string(fault.what()) +
                     "; for a mesh with inner lines, or with blocks that touch its boundary, give --from "
                     "OLD.geom with the same pieces and numbers of points");
  }
  if (!arguments.from.empty()) input.from = io::read_outline(arguments.from, warnings);
}

/// Whether the boundaries of the mesh are closed loops and the mesh has no inner lines or baffles.
bool is_closed(const io::LoadedMesh& whole) {
  return whole.inner_curves.empty() && !PointTable(whole.mesh.points).any_twice() &&
         adapt::has_closed_boundaries(whole.mesh);
}

/// *Collective.*
MorphInput load(const CommandContext& context, const MorphArguments& arguments) {
  MorphInput input;
  Warnings& warnings = context.record.noted;
  bool closed = true;
  context.comm.together([&] {
    io::require_readable_suffix(arguments.input);
    require_outputs(arguments);
    if (!arguments.output.empty()) io::require_writable_suffix(arguments.output);
    if (!arguments.nodal_gradient.empty()) io::require_solution_suffix(arguments.nodal_gradient);
    if (!context.comm.is_root()) return;
    require_other_outputs(arguments);
    input.whole = io::read_mesh(arguments.input);
    io::tidy_mesh(input.whole, arguments.input);
    require_valid_input(input.whole, arguments.input);
    const auto append = [&](const Warnings& more) {
      warnings.insert(warnings.end(), more.begin(), more.end());
    };
    append(input.whole.warnings);
    if (!arguments.output.empty()) append(io::losses_in(input.whole, arguments.output));
    input.order = space_filling_order(input.whole.mesh);
    closed = is_closed(input.whole);
  });
  closed = !context.comm.any(!closed);
  context.comm.together([&] {
    read_geometries(arguments, closed, input, warnings);
    if (!arguments.direction.empty())
      input.direction = io::read_point_table(arguments.direction, *input.to, {"dx", "dy"});
  });
  return input;
}

[[noreturn]] void refuse_way(const MorphArguments& arguments, const adapt::MorphReport& report) {
  throw InputError(
      fmt::format("{}: cannot morph to {}: cells near ({:g}, {:g}) become inverted after {:.0f} % of the "
                  "movement; use smaller steps, or generate a new mesh",
                  arguments.input, arguments.geometry, report.worst_place.x, report.worst_place.y,
                  100 * report.possible_way));
}

void require_derivative(const MorphArguments& arguments, const adapt::MorphReport& report) {
  if (report.smoothed)
    throw InputError(fmt::format(
        "{}: the mesh had to be smoothed on {}, so the node positions have no derivative; start from a mesh "
        "closer to that geometry",
        arguments.input, arguments.geometry));
}

/// Adds the nodes' velocities to the whole mesh's solution. *Collective.*
void add_velocities(const Communicator& comm, const Mesh& part, const std::vector<Point>& velocity,
                    MorphInput& input) {
  Field field{velocity_names, {}, {}};
  for (const Point& v : velocity) field.values.insert(field.values.end(), {v.x, v.y});
  const Field of_whole = gather_field(comm, field, part, input.order);
  if (!comm.is_root()) return;
  const Field before = input.whole.solution.value_or(Field{});
  Field& joined = input.whole.solution.emplace(before);
  std::erase_if(joined.names,
                [](const std::string& name) { return std::ranges::count(velocity_names, name) > 0; });
  const Field kept = selected(before, joined.names, "the mesh's solution");
  joined.values = kept.values;
  append_columns(joined, velocity_names, of_whole.values);
}

/// Reads dJ/dX of the morphed mesh's nodes and writes dJ/d(points) of the geometry. *Collective.*
void write_outline_gradient(const Communicator& comm, const MorphArguments& arguments,
                            const MorphInput& input, const Mesh& part,
                            const adapt::MorphDerivative& derivative) {
  Field of_whole;
  comm.together([&] {
    if (!comm.is_root()) return;
    const io::LoadedSolution solution = io::read_solution(arguments.nodal_gradient);
    io::require_same_mesh(solution, input.whole.mesh);
    of_whole = selected(solution.solution, arguments.fields, arguments.nodal_gradient);
    of_whole.constants.clear();
  });
  const Field field = scatter_field(comm, of_whole, part, input.order);
  std::vector<Point> of_nodes;
  for (const NodeId node : ids_below(NodeId{part.owned_nodes}))
    of_nodes.push_back({field.row(node)[0], field.row(node)[1]});
  const std::vector<Point> gradient = derivative.gradient(of_nodes);
  io::OutputSet outputs(comm);
  io::TextOutput file(outputs, arguments.outline_gradient);
  std::string text;
  comm.together([&] {
    if (comm.is_root()) text = io::point_table(*input.to, arguments.geometry, gradient, "dJ_dx,dJ_dy");
  });
  file.write(text);
  file.close();
  outputs.commit();
}

/// *Collective.*
void use_derivative(const Communicator& comm, const MorphArguments& arguments, const Mesh& part,
                    const adapt::MorphDerivative& derivative, MorphInput& input) {
  if (!arguments.direction.empty()) add_velocities(comm, part, derivative.velocity(input.direction), input);
  if (!arguments.outline_gradient.empty()) write_outline_gradient(comm, arguments, input, part, derivative);
}

Statistics statistics_of(const adapt::MorphReport& report) {
  Statistics statistics;
  statistics.add("nodes moved", report.moved);
  statistics.add("largest move", report.largest_move, "{:.4g}");
  statistics.add("worst quality before", report.worst_before, "{:.3f}");
  statistics.add("worst quality after", report.worst_after, "{:.3f}");
  statistics.add_raw("smoothed", report.smoothed ? "yes" : "no", report.smoothed ? "true" : "false");
  return statistics;
}

/// Distributes the mesh with its inner lines. *Collective.*
Mesh distributed(const Communicator& comm, const MorphInput& input) {
  if (!comm.any(!input.whole.inner_curves.empty())) return scatter_mesh(comm, input.whole.mesh, input.order);
  io::LoadedMesh listed = input.whole;
  io::list_inner_curves(listed);
  return scatter_mesh(comm, listed.mesh, input.order);
}

/// Flags the nodes between blocks and those of inner lines; empty if there are none.
NodeFlags inner_nodes(const io::LoadedMesh& whole) {
  NodeFlags flags;
  if (whole.blocks > 1) flags = io::interface_nodes(whole);
  if (!whole.inner_curves.empty()) flags.resize(whole.mesh.points.size(), 0);
  for (const BoundaryEdges& line : whole.inner_curves) {
    for (const auto& edge : line.edges) flag_all(edge, flags);
  }
  return flags;
}

void run_morph(const CommandContext& context, const MorphArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  MorphInput input = load(context, arguments);
  Mesh part = distributed(comm, input);
  NodeFlags inner;
  if (comm.is_root()) inner = inner_nodes(input.whole);
  inner = NodeFlags(scatter_nodes(comm, inner, input.order));
  times.begin("morph");
  const adapt::OutlineChange change{*input.to, arguments.geometry, input.from ? &*input.from : nullptr,
                                    arguments.from, input.by_pieces};
  std::optional<adapt::MorphDerivative> derivative;
  if (arguments.wants_derivative()) derivative.emplace(comm, part, change);
  const adapt::MorphReport report = adapt::morph_mesh(comm, part, change, inner);
  if (!report.valid()) refuse_way(arguments, report);
  gather_mesh(comm, part, input.order, input.whole.mesh);
  comm.together([&] {
    if (comm.is_root())
      require_valid(input.whole, arguments.output.empty() ? arguments.geometry : arguments.output);
  });
  if (derivative) {
    require_derivative(arguments, report);
    times.begin("derivative");
    use_derivative(comm, arguments, part, *derivative, input);
  }
  times.begin("write");
  if (!arguments.output.empty()) io::write_mesh_of_root(comm, input.whole, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  if (!arguments.output.empty()) context.record.files = io::with_files_beside({arguments.output});
  if (!arguments.outline_gradient.empty()) context.record.files.push_back(arguments.outline_gradient);
  if (!comm.is_root()) return;
  const Statistics statistics = statistics_of(report);
  context.record.statistics = statistics.record();
  context.record.statistics.add("seconds", record_of(stages));
  if (context.shows_table())
    std::cout << statistics.table(24) << stage_table(stages)
              << fmt::format("  wrote {}\n", fmt::join(context.record.files, ", "));
}

void add_derivative_options(Command& command, MorphArguments& arguments) {
  command
      .add_option("--direction", arguments.direction,
                  "table boundary,x,y,dx,dy of the displacements of points of NEW.geom: OUT contains the "
                  "nodal velocities as dx_ds and dy_ds")
      .value_name("TABLE.csv");
  command
      .add_option("--nodal-gradient", arguments.nodal_gradient,
                  "dJ/dX at the nodes of the mesh on the new geometry, in the fields dJ_dx and dJ_dy of an "
                  "adjoint solution")
      .value_name("SOLUTION");
  command
      .add_option("--outline-gradient", arguments.outline_gradient,
                  "writes the gradient of J with respect to the points of NEW.geom: boundary,x,y,dJ_dx,dJ_dy")
      .value_name("TABLE.csv");
  command.add_option("--fields", arguments.fields, "other names of the two fields of --nodal-gradient")
      .count(2)
      .value_name("NAME");
}

}  // namespace

void add_morph_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<MorphArguments>();
  Command command = line.add_command("morph", "move the nodes of a mesh to a changed geometry");
  command.add_option("input", arguments->input, "the mesh (" + io::suffixes_for({io::Content::mesh}) + ")")
      .required()
      .value_name("IN");
  command
      .add_option("--geometry", arguments->geometry,
                  "the new geometry; boundaries that are not in it stay in place")
      .required()
      .value_name("NEW.geom");
  command
      .add_option("--from", arguments->from,
                  "the geometry on which IN was made: if NEW.geom has as many points, nodes stay on their "
                  "segments, otherwise they keep their relative arc length between feature points")
      .value_name("OLD.geom");
  command
      .add_option("-o,--output", arguments->output,
                  "the mesh on the new geometry, in the format of its suffix")
      .value_name("OUT");
  add_derivative_options(command, *arguments);
  command.set_work([&context, arguments] { run_morph(context, *arguments); });
}

}  // namespace quadloop::app
