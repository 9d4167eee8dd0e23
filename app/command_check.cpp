#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include "app/command.hpp"
#include "app/report/check_report.hpp"
#include "app/report/mesh3d_report.hpp"
#include "app/report/refusals.hpp"
#include "io/formats.hpp"
#include "io/input/geometry_file.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop::app {

namespace {

struct CheckArguments {
  std::string input, geometry;
};

/// Whether chains are not the outline of one domain, but also interfaces, inner lines or baffles.
bool has_more_than_outline(const io::LoadedMesh& loaded, std::span<const Chain> chains) {
  if (loaded.blocks > 1 || !loaded.inner_curves.empty()) return true;
  std::set<std::pair<Point, Point>> seen;
  return std::ranges::any_of(chains, [&](const Chain& chain) {
    for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
      seen.emplace(chain.points[i], chain.points[i + 1]);
      if (seen.contains({chain.points[i + 1], chain.points[i]})) return true;
    }
    return false;
  });
}

/// Returns the geometry as `mesh` would use it: joined, with consistently directed loops. Unless it is the
/// outline of a single domain it is left unchanged. Every rank reads it. *Collective.*
std::vector<Chain> load_chains(const CommandContext& context, const std::string& path,
                               const io::LoadedMesh& loaded) {
  Warnings warnings;
  std::vector<Chain> chains;
  context.comm.together([&] {
    chains = io::read_geometry(path, warnings);
    AssembleOptions options;
    options.domain_is_known = true;
    if (!has_more_than_outline(loaded, chains))
      chains = chains_of(assemble(std::move(chains), options, warnings));
  });
  context.warn(warnings);
  return chains;
}

/// Returns the number of edges of each boundary. *Collective.*
CheckReport::Edges edges_of(const Communicator& comm, const std::vector<BoundaryEdges>& boundaries) {
  std::vector<std::int64_t> counts;
  for (const BoundaryEdges& boundary : boundaries) counts.push_back(std::ssize(boundary.edges));
  counts = comm.sum(counts);
  CheckReport::Edges edges;
  for (std::size_t b = 0; b < boundaries.size(); ++b) edges.emplace_back(boundaries[b].name, counts[b]);
  return edges;
}

/// Adds what is computed on a HaloMesh, and the fit to the geometry, if there is one. *Collective.*
void examine_halo(const Communicator& comm, const io::LoadedMesh& loaded, const LayerPlaces& places,
                  const std::vector<Chain>& chains, bool with_geometry, CheckReport& report) {
  const Mesh& mesh = loaded.mesh;
  const CellBlocks blocks{loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block};
  const HaloMesh halo(comm, mesh);
  const EdgeStatistics edges = edge_statistics(comm, mesh, halo, blocks);
  report.shape = shape_statistics(comm, mesh, halo, edges, chains);
  report.largest_area_ratio = edges.ratios.place;
  report.pinched_nodes = edges.pinched_nodes;
  report.regions = edges.regions;
  report.interfaces = interface_edges(comm, mesh, edges.between_blocks);
  if (has_layers(mesh)) report.layers = layer_statistics(comm, mesh, halo, places);
  if (!with_geometry || report.quality.counts.triangles + report.quality.counts.quads == 0) return;
  if (loaded.inner_curves.empty()) {
    report.fit = validate_geometry(comm, mesh, halo, edges, chains, blocks);
    return;
  }
  io::LoadedMesh listed = loaded;
  io::list_inner_curves(listed);
  report.fit = validate_geometry(comm, listed.mesh, halo, edges, chains, blocks);
}

/// Checks a distributed mesh whose connectivity is valid, as that of every mesh read from a file is. It is
/// gathered on the root only to name its faults, unless it is certainly valid. *Collective.*
CheckReport examine(const Communicator& comm, const io::LoadedMesh& loaded, const std::vector<Chain>& chains,
                    bool with_geometry) {
  const Mesh& mesh = loaded.mesh;
  CheckReport report;
  report.blocks = block_statistics(
      comm, mesh, {loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block}, loaded.block_names);
  report.boundaries = edges_of(comm, mesh.boundaries);
  report.inner_lines = edges_of(comm, loaded.inner_curves);
  for (const PeriodicPair& pair : mesh.pairs) report.pairs.push_back(pair.from + " and " + pair.to);
  report.quality = summarise_quality(comm, mesh);
  report.statistics = solver_statistics(comm, mesh);
  LayerPlaces places;
  if (has_layers(mesh)) {
    places = layer_places(comm, mesh);
    report.by_layers = quality_by_layers(comm, mesh, places);
  }
  report.faces = face_statistics(comm, mesh, places);
  report.worst = worst_places(comm, mesh, places);
  report.area = reproducible_sum(comm, cell_areas(mesh));
  examine_halo(comm, loaded, places, chains, with_geometry, report);
  places = {};
  report.faults = faults_of(comm, loaded);
  if (report.fit)
    report.faults.insert(report.faults.end(), report.fit->faults.begin(), report.fit->faults.end());
  return report;
}

std::string regions_warning(const CheckReport& report) {
  const MeshRegions& regions = report.regions;
  return fmt::format(
      "{}: the mesh has {} connected regions; the smallest, of {}, has a node at ({:.6g}, {:.6g})",
      report.file, regions.count, counted(regions.smallest_cells, "cell"), regions.smallest_place.x,
      regions.smallest_place.y);
}

void check_mesh3d_on_root(const CommandContext& context, const CheckArguments& arguments,
                          const io::FileMesh& mesh) {
  if (!arguments.geometry.empty())
    throw UsageError(arguments.input +
                     ": is a 3D mesh, which cannot be compared with a geometry; remove --geometry");
  context.warn(mesh.warnings);
  const io::Mesh3dStatistics statistics = io::check_mesh3d(mesh);
  context.record.statistics = mesh3d_record(arguments.input, mesh, statistics);
  if (context.shows_table()) std::cout << mesh3d_text(mesh, statistics, context.verbose) << std::flush;
  if (!statistics.faults.empty()) refuse_invalid_mesh3d(arguments.input, statistics);
}

/// *Collective.*
void check_plane(const CommandContext& context, const CheckArguments& arguments,
                 const io::LoadedMesh& loaded) {
  const Communicator& comm = context.comm;
  context.warn(loaded.warnings);
  const bool with_geometry = !arguments.geometry.empty();
  std::vector<Chain> chains;
  if (with_geometry) chains = load_chains(context, arguments.geometry, loaded);
  CheckReport report = examine(comm, loaded, chains, with_geometry);
  report.file = arguments.input;
  if (report.regions.count > 1) context.warn({regions_warning(report)});
  comm.together([&] {
    if (!comm.is_root()) return;
    context.record.statistics = report_record(report);
    if (context.shows_table()) std::cout << report_text(report, context.verbose) << std::flush;
    if (!report.faults.empty()) refuse_invalid(report.file, report.faults);
  });
}

/// A 3D mesh is whole on the root. *Collective.*
void run_check(const CommandContext& context, const CheckArguments& arguments) {
  const io::MeshOfFile mesh = io::read_mesh_file(context.comm, arguments.input);
  if (const io::LoadedMesh* plane = std::get_if<io::LoadedMesh>(&mesh))
    return check_plane(context, arguments, *plane);
  context.comm.together([&] {
    if (context.comm.is_root()) check_mesh3d_on_root(context, arguments, std::get<io::FileMesh>(mesh));
  });
}

}  // namespace

void add_check_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<CheckArguments>();
  Command command = line.add_command("check", "check the validity and quality of a mesh");
  command
      .add_option("input", arguments->input,
                  "the mesh: 2D (" + io::read_suffixes_for({io::Content::mesh}) + ") or 3D (" +
                      io::read_suffixes_for({io::Content::mesh3d}) + ", a folder)")
      .required()
      .value_name("IN");
  command
      .add_option("--geometry", arguments->geometry,
                  "the geometry of the mesh, as written by `mesh --geometry-out`")
      .value_name("FILE.geom");
  command.set_work([&context, arguments] { run_check(context, *arguments); });
}

}  // namespace quadloop::app
