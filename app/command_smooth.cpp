#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/refusals.hpp"
#include "app/report/smooth_report.hpp"
#include "app/report/summary.hpp"
#include "io/formats.hpp"
#include "io/input/geometry_file.hpp"
#include "io/mesh_file.hpp"
#include "io/model/fixed_nodes.hpp"
#include "io/model/interface_nodes.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/solver_statistics.hpp"
#include "mesher/mesh/paired_nodes.hpp"
#include "mesher/mesh/periodic_mesh.hpp"
#include "mesher/mesh/reorder_mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "smoother/keep_layers.hpp"
#include "smoother/outline/outline_match.hpp"
#include "smoother/smooth_mesh.hpp"

namespace quadloop::app {

namespace {

struct SmoothArguments {
  std::string input, output, geometry, method = "perturb", objective = "power";
  int sweeps = 20;
  std::vector<std::string> fix;  ///< names of boundaries, inner curves and blocks
};

/// The mesh, in the order of its file, and the geometry.
struct Loaded {
  io::LoadedMesh mesh;
  NodeFlags pinned;  ///< of owned nodes: nodes_that_stay(), and fix_nodes(); empty if there are none
  std::optional<Geometry> geometry;
  bool delaunay = false;  ///< false if flips could cross inner curves
};

/// Cells of layers are split by the shorter diagonals, which may not be Delaunay. *Collective.*
bool is_delaunay_outside_layers(const Communicator& comm, const io::LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  return is_delaunay(
      comm, mesh, smoother::blocks_for_flips(comm, mesh, layer_places(comm, mesh), loaded.triangle_to_block));
}

constexpr double most_stretched = 20;  // longest over shortest edge

/// Warns that layers of another program's mesh would be lost by smoothing. *Collective.*
Warnings doubts_about_stretched(const Communicator& comm, const Mesh& mesh, const std::string& path) {
  if (has_layers(mesh)) return {};
  std::int64_t stretched = 0;
  const auto look_at = [&](const auto& nodes) {
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double edge = length(mesh.point(nodes[(k + 1) % nodes.size()]) - mesh.point(nodes[k]));
      shortest = std::min(shortest, edge);
      longest = std::max(longest, edge);
    }
    if (longest > most_stretched * shortest) ++stretched;
  };
  mesh.for_each_cell(look_at);
  stretched = comm.sum(stretched);
  if (stretched == 0) return {};
  return {fmt::format(
      "{}: {} with an aspect ratio above {:g}; smoothing makes layers among them uniform, unless a "
      ".mesh file has the line '# layers NAME COUNT' before the number of edges of the wall",
      path, counted(stretched, "cell"), most_stretched)};
}

void append(Warnings& warnings, const Warnings& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

/// Nodes of periodic pairs move with their partners, and stay where these cannot be joined. *Collective.*
void mark_pairs_that_stay(const Communicator& comm, io::LoadedMesh& loaded) {
  if (loaded.mesh.pairs.empty() || join_pairs_if_possible(comm, loaded.mesh)) return;
  const std::vector<NodeId> nodes = nodes_on_sides(loaded.mesh);
  loaded.periodic_nodes.insert(loaded.periodic_nodes.end(), nodes.begin(), nodes.end());
}

/// Compares the mesh with the geometry of the first rank, turns loops of this that are against the mesh, and
/// gives it to all ranks. *Collective.*
void match_geometry(const Communicator& comm, const std::string& path, Loaded& loaded, Warnings& warnings) {
  const Mesh boundaries = gather_boundaries(comm, loaded.mesh.mesh);
  comm.on_first([&] {
    const Geometry& outline = *loaded.geometry;
    append(warnings, smoother::require_match(outline, boundaries, path));
    loaded.geometry = smoother::with_loops_turned(outline, smoother::loops_against(outline, boundaries));
  });
  loaded.geometry = Geometry::once_per_node(comm, std::move(loaded.geometry));
}

/// Every rank reads its share of the mesh, and the first one the geometry. *Collective.*
Loaded load(const CommandContext& context, const SmoothArguments& arguments) {
  const Communicator& comm = context.comm;
  Loaded loaded;
  Warnings& warnings = context.record.noted;
  comm.on_first([&] {
    io::require_readable_suffix(arguments.input);
    io::require_writable_suffix(arguments.output);
    if (!arguments.geometry.empty()) loaded.geometry = io::read_outline(arguments.geometry, warnings);
    io::require_possible_outputs({arguments.output});
  });
  io::LoadedMesh& mesh = loaded.mesh = io::read_mesh(comm, arguments.input);
  std::vector<char> stay;
  repair(comm, mesh, arguments.input, [&](const io::LoadedMesh& whole) {
    require_sound_topology(whole, arguments.input);
    const NodeFlags flags = io::nodes_that_stay(whole);
    stay.assign(flags.begin(), flags.end());
  });
  loaded.pinned = NodeFlags(in_even_shares(comm, std::move(stay)));
  append(warnings, mesh.warnings);
  if (!arguments.geometry.empty()) match_geometry(comm, arguments.geometry, loaded, warnings);
  mark_pairs_that_stay(comm, mesh);
  if (arguments.sweeps > 0)
    append(warnings, io::fix_nodes(comm, mesh, arguments.fix, arguments.input, loaded.pinned));
  loaded.delaunay = mesh.inner_curves.empty() && is_delaunay_outside_layers(comm, mesh);
  append(warnings, doubts_about_stretched(comm, mesh.mesh, arguments.input));
  if (mesh.solution && arguments.sweeps > 0)
    warnings.push_back(
        arguments.input +
        ": the solution keeps its values at the nodes, which move; it is that of the old mesh");
  append(warnings, io::losses_in(comm, mesh, arguments.output));
  return loaded;
}

smoother::SmoothOptions options_of(const Communicator& comm, const SmoothArguments& arguments,
                                   const Loaded& loaded, const ReorderedMesh& reordered, const Mesh& part) {
  smoother::SmoothOptions options;
  options.sweeps = arguments.sweeps;
  options.method = *value_of(smoother::method_words, arguments.method);
  options.objective = *value_of(smoother::objective_words, arguments.objective);
  if (comm.any(!loaded.pinned.empty())) options.pinned = NodeFlags(reordered.of_nodes(loaded.pinned));
  options.geometry = loaded.geometry ? &*loaded.geometry : nullptr;
  if (loaded.delaunay) {
    options.triangle_to_block = reordered.of_triangles(loaded.mesh.triangle_to_block);
    options.delaunay = [centre = box_over_ranks(comm, part.points).centre()](Point p) {
      return tie_rank(centre, p);
    };
  }
  smoother::keep_layers(comm, part, options);
  return options;
}

/// Warns if all quads were parallelograms, as node-centred solvers prefer, and some are not any more: this
/// command does not split cells.
void warn_of_skew_quads(const CommandContext& context, const std::string& output,
                        const SolverStatistics& statistics) {
  const std::int64_t skew = statistics.quads - statistics.parallelograms;
  if (skew == 0) return;
  context.warn(
      {fmt::format("{}: {} of the {} quads were parallelograms and no longer are; `mesh` with mesh.quads = "
                   "\"parallel\" would divide them",
                   output, skew, statistics.quads)});
}

/// Smooths and writes; returns the text to show, on the root only. *Collective.*
std::string smooth_and_write(const CommandContext& context, const SmoothArguments& arguments, Loaded& loaded,
                             StageTimes& times) {
  const Communicator& comm = context.comm;
  const ReorderedMesh reordered(comm, loaded.mesh.mesh, space_filling_order(comm, loaded.mesh.mesh));
  Mesh part = reordered.take(loaded.mesh.mesh);
  const bool parallel =
      comm.any(!part.quads.empty()) && solver_statistics(comm, part).parallelogram_share() == 1;
  smoother::SmoothOptions options = options_of(comm, arguments, loaded, reordered, part);
  if (parallel) options = smoother::sparing_parallelograms(options);
  times.begin("report");
  const ShapeReport before = report_shapes(comm, part);
  times.begin("smooth");
  const smoother::SmoothReport smoothed = smoother::smooth_mesh(comm, part, options);
  times.begin("report");
  const ShapeReport after = report_shapes(comm, part);
  times.begin("check");
  if (parallel) warn_of_skew_quads(context, arguments.output, solver_statistics(comm, part));
  reordered.put_back(std::exchange(part, {}), loaded.mesh.mesh);
  require_valid(comm, loaded.mesh, arguments.input);
  times.begin("write");
  io::write_mesh_file(comm, loaded.mesh, arguments.output);
  times.end();
  const std::vector<StageRow> stages = stage_rows(comm, times.stages());
  if (!comm.is_root()) return {};
  Statistics work;
  work.add("sweeps", smoothed.sweeps);
  work.add("nodes that may move", smoothed.free_nodes);
  work.add("moves", smoothed.moves);
  context.record.statistics = work.record();
  context.record.statistics.add("before", record_of(before));
  context.record.statistics.add("after", record_of(after));
  context.record.statistics.add("seconds", record_of(stages));
  return comparison_table(before, after) + work.table(24) + stage_table(stages);
}

/// Without sweeps a mesh only changes its format, and its shapes are not reported.
void run_smooth(const CommandContext& context, const SmoothArguments& arguments) {
  StageTimes times;
  times.begin("read");
  Loaded loaded = load(context, arguments);
  std::string text;
  if (arguments.sweeps == 0) {
    require_valid(context.comm, loaded.mesh, arguments.input);
    io::write_mesh_file(context.comm, loaded.mesh, arguments.output);
  } else {
    text = smooth_and_write(context, arguments, loaded, times);
  }
  context.record.files = io::with_files_beside({arguments.output});
  if (context.shows_table())
    std::cout << text << fmt::format("  wrote {}\n", fmt::join(context.record.files, ", "));
}

}  // namespace

void add_smooth_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<SmoothArguments>();
  Command command = line.add_command("smooth", "improve the cell shapes of a mesh by moving its nodes");
  command
      .add_option("input", arguments->input, "the mesh (" + io::read_suffixes_for({io::Content::mesh}) + ")")
      .required()
      .value_name("IN");
  command
      .add_option("-o,--output", arguments->output,
                  "the smoothed mesh, in the format of its suffix; IN itself is overwritten")
      .required()
      .value_name("OUT");
  command.add_option("--sweeps", arguments->sweeps, "largest number of visits to each node (default: 20)")
      .value_name("N")
      .between(0, 100000);
  command.add_option("--method", arguments->method, "optimisation method: perturb (the default) or nlopt")
      .value_name("METHOD")
      .one_of(words_of(smoother::method_words));
  command
      .add_option("--objective", arguments->objective,
                  "objective function: power (the default) or thesis (Eq. 3.4)")
      .value_name("COST")
      .one_of(words_of(smoother::objective_words));
  command
      .add_option("--geometry", arguments->geometry,
                  "geometry along which boundary nodes may slide, as written by `mesh --geometry-out`")
      .value_name("FILE.geom");
  command
      .add_option("--fix", arguments->fix,
                  "boundaries, inner curves or blocks whose nodes are fixed; nodes of inner curves and of "
                  "periodic sides other than pairs are always fixed")
      .value_name("NAME");
  command.set_work([&context, arguments] { run_smooth(context, *arguments); });
}

}  // namespace quadloop::app
