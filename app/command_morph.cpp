#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/refusals.hpp"
#include "app/report/statistics.hpp"
#include "app/report/summary.hpp"
#include "io/formats.hpp"
#include "io/input/point_table.hpp"
#include "io/mesh_file.hpp"
#include "io/solution_file.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/reorder_mesh.hpp"
#include "quadloop/quadloop.hpp"

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

/// Input: the geometries, and the mesh in the order of its file.
struct MorphInput {
  io::LoadedMesh loaded;
  MorphGeometry from, to;
  io::PointVectors direction;  ///< for each point of each line of `to`
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

/// *Collective.*
MorphInput load(const CommandContext& context, const MorphArguments& arguments) {
  MorphInput input;
  Warnings& warnings = context.record.noted;
  const auto append = [&](const Warnings& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  context.comm.together([&] {
    io::require_readable_suffix(arguments.input);
    require_outputs(arguments);
    if (!arguments.output.empty()) io::require_writable_suffix(arguments.output);
    if (!arguments.nodal_gradient.empty()) io::require_solution_suffix(arguments.nodal_gradient);
    if (context.comm.is_root()) require_other_outputs(arguments);
  });
  input.loaded = io::read_mesh(context.comm, arguments.input);
  repair(context.comm, input.loaded, arguments.input, [&](const io::LoadedMesh& whole) {
    require_valid_input(Communicator(MPI_COMM_SELF), whole, arguments.input);
  });
  append(input.loaded.warnings);
  if (!arguments.output.empty()) append(io::losses_in(context.comm, input.loaded, arguments.output));
  input.to = MorphGeometry(context.comm, arguments.geometry);
  append(input.to.warnings());
  if (!arguments.from.empty()) input.from = MorphGeometry(context.comm, arguments.from);
  append(input.from.warnings());
  if (arguments.direction.empty()) return input;
  context.comm.together([&] {
    input.direction = io::read_point_table(arguments.direction, input.to.lines(), {"dx", "dy"});
  });
  return input;
}

/// Returns the mesh along a space-filling curve, with its inner lines and blocks. *Collective.*
Mesh along_curve(const ReorderedMesh& reordered, const MorphInput& input) {
  io::LoadedMesh listed = input.loaded;
  io::list_inner_curves(listed);
  Mesh part = reordered.mesh(listed.mesh);
  part.blocks = reordered.blocks(listed.mesh.blocks);
  return part;
}

/// *Collective.*
Morph morphed(const Communicator& comm, const MorphArguments& arguments, const ReorderedMesh& reordered,
              const MorphInput& input) {
  try {
    return {comm, along_curve(reordered, input), input.from, input.to};
  } catch (const TooFar& error) {
    throw InputError(
        fmt::format("{}: cannot morph to {}: {}", arguments.input, arguments.geometry, error.what()));
  }
}

/// Adds the nodes' velocities to the mesh's solution. *Collective.*
void add_velocities(const ReorderedMesh& reordered, const std::vector<Point>& velocity, MorphInput& input) {
  Field field{velocity_names, {}, {}};
  for (const Point& v : velocity) field.values.insert(field.values.end(), {v.x, v.y});
  field = reordered.field_back(field);
  const Field before = input.loaded.solution.value_or(Field{});
  Field& joined = input.loaded.solution.emplace(before);
  std::erase_if(joined.names,
                [](const std::string& name) { return std::ranges::count(velocity_names, name) > 0; });
  const Field kept = selected(before, joined.names, "the mesh's solution");
  joined.values = kept.values;
  append_columns(joined, velocity_names, field.values);
}

/// Reads dJ/dX of the morphed mesh's nodes and writes dJ/d(points) of the geometry. *Collective.*
void write_outline_gradient(const Communicator& comm, const MorphArguments& arguments,
                            const ReorderedMesh& reordered, const MorphInput& input, const Morph& morph) {
  const io::LoadedSolution solution = io::read_solution(comm, arguments.nodal_gradient);
  io::require_same_mesh(comm, solution, input.loaded.mesh);
  const Field field =
      reordered.field(selected(solution.solution, arguments.fields, arguments.nodal_gradient));
  std::vector<Point> of_nodes;
  for (const NodeId node : ids_below(NodeId{morph.mesh()->owned_nodes}))
    of_nodes.push_back({field.row(node)[0], field.row(node)[1]});
  const io::PointVectors gradient = morph.pull_back(of_nodes);
  io::OutputSet outputs(comm);
  io::TextOutput file(outputs, arguments.outline_gradient);
  std::string text;
  comm.together([&] {
    if (comm.is_root()) text = io::point_table(input.to.lines(), gradient, "dJ_dx,dJ_dy");
  });
  file.write(text);
  file.close();
  outputs.commit();
}

/// *Collective.*
void use_derivative(const Communicator& comm, const MorphArguments& arguments, const ReorderedMesh& reordered,
                    const Morph& morph, MorphInput& input) {
  if (morph.report().smoothed)
    throw InputError(arguments.input + ": " + adapt::text_of_smoothing(arguments.geometry));
  if (!arguments.direction.empty()) add_velocities(reordered, morph.push_forward(input.direction), input);
  if (!arguments.outline_gradient.empty()) write_outline_gradient(comm, arguments, reordered, input, morph);
}

Statistics statistics_of(const MorphReport& report) {
  Statistics statistics;
  statistics.add("nodes moved", report.moved);
  statistics.add("largest move", report.largest_move, "{:.4g}");
  statistics.add("worst quality before", report.worst_before, "{:.3f}");
  statistics.add("worst quality after", report.worst_after, "{:.3f}");
  statistics.add_raw("smoothed", report.smoothed ? "yes" : "no", report.smoothed ? "true" : "false");
  return statistics;
}

void run_morph(const CommandContext& context, const MorphArguments& arguments) {
  const Communicator& comm = context.comm;
  StageTimes times;
  times.begin("read");
  MorphInput input = load(context, arguments);
  times.begin("morph");
  const ReorderedMesh reordered(comm, input.loaded.mesh, space_filling_order(comm, input.loaded.mesh));
  const Morph morph = morphed(comm, arguments, reordered, input);
  reordered.put_back(*morph.mesh(), input.loaded.mesh);
  require_valid(comm, input.loaded, arguments.output.empty() ? arguments.geometry : arguments.output);
  if (arguments.wants_derivative()) {
    times.begin("derivative");
    use_derivative(comm, arguments, reordered, morph, input);
  }
  times.begin("write");
  if (!arguments.output.empty()) io::write_mesh_file(comm, input.loaded, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  if (!arguments.output.empty()) context.record.files = io::with_files_beside({arguments.output});
  if (!arguments.outline_gradient.empty()) context.record.files.push_back(arguments.outline_gradient);
  if (!comm.is_root()) return;
  const Statistics statistics = statistics_of(morph.report());
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
  command
      .add_option("input", arguments->input, "the mesh (" + io::read_suffixes_for({io::Content::mesh}) + ")")
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
