#include <fmt/format.h>
#include <mpi.h>

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
/// outline of a single domain it is left unchanged.
std::vector<Chain> load_chains(const CommandContext& context, const std::string& path,
                               const io::LoadedMesh& loaded) {
  Warnings warnings;
  std::vector<Chain> chains = io::read_geometry(path, warnings);
  AssembleOptions options;
  options.domain_is_known = true;
  if (!has_more_than_outline(loaded, chains))
    chains = chains_of(assemble(std::move(chains), options, warnings));
  context.warn(warnings);
  return chains;
}

/// Compares the boundaries and inner lines of a mesh with the geometry.
GeometryFit fit_to(const io::LoadedMesh& loaded, const std::vector<Chain>& chains, const CellBlocks& blocks) {
  if (loaded.inner_curves.empty()) return validate_geometry(loaded.mesh, chains, blocks);
  io::LoadedMesh listed = loaded;
  io::list_inner_curves(listed);
  return validate_geometry(listed.mesh, chains, blocks);
}

/// Checks a mesh whose connectivity is valid, as that of every mesh read from a file is.
CheckReport examine(const io::LoadedMesh& loaded, const std::vector<Chain>* chains) {
  const Mesh& mesh = loaded.mesh;
  CheckReport report;
  const CellBlocks blocks{loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block};
  report.blocks = block_statistics(mesh, blocks, loaded.block_names);
  for (const BoundaryEdges& boundary : mesh.boundaries)
    report.boundaries.emplace_back(boundary.name, boundary.edges.size());
  for (const BoundaryEdges& line : loaded.inner_curves)
    report.inner_lines.emplace_back(line.name, line.edges.size());
  for (const PeriodicPair& pair : mesh.pairs) report.pairs.push_back(pair.from + " and " + pair.to);
  report.quality = summarise_quality(Communicator(MPI_COMM_SELF), mesh);
  const MeshTopology topology(mesh);
  report.shape =
      shape_statistics(mesh, topology, chains == nullptr ? std::span<const Chain>() : std::span(*chains));
  report.statistics = solver_statistics(Communicator(MPI_COMM_SELF), mesh);
  LayerPlaces places;
  if (has_layers(mesh)) {
    places = layer_places(Communicator(MPI_COMM_SELF), mesh);
    report.layers = layer_statistics(mesh, places);
    report.by_layers = quality_by_layers(Communicator(MPI_COMM_SELF), mesh, places);
  }
  report.faces = face_statistics(Communicator(MPI_COMM_SELF), mesh, places);
  report.worst = worst_places(mesh, topology, places);
  report.area = area_of(mesh);
  report.pinched_nodes = pinched_nodes(mesh, topology);
  report.regions = connected_regions(mesh, topology);
  report.interfaces = interface_edges(mesh, blocks, topology);
  report.faults = validate(mesh, blocks);
  const bool has_cells = report.quality.counts.triangles + report.quality.counts.quads > 0;
  if (chains == nullptr || !has_cells) return report;
  report.fit = fit_to(loaded, *chains, blocks);
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

void check_plane_on_root(const CommandContext& context, const CheckArguments& arguments,
                         const io::LoadedMesh& loaded) {
  context.warn(loaded.warnings);
  std::vector<Chain> chains;
  if (!arguments.geometry.empty()) chains = load_chains(context, arguments.geometry, loaded);
  CheckReport report = examine(loaded, arguments.geometry.empty() ? nullptr : &chains);
  report.file = arguments.input;
  if (report.regions.count > 1) context.warn({regions_warning(report)});
  context.record.statistics = report_record(report);
  if (context.shows_table()) std::cout << report_text(report, context.verbose) << std::flush;
  if (!report.faults.empty()) refuse_invalid(report.file, report.faults);
}

void check_on_root(const CommandContext& context, const CheckArguments& arguments) {
  const io::MeshOfFile mesh = io::read_mesh_file(arguments.input);
  if (const io::LoadedMesh* plane = std::get_if<io::LoadedMesh>(&mesh))
    check_plane_on_root(context, arguments, *plane);
  else
    check_mesh3d_on_root(context, arguments, std::get<io::FileMesh>(mesh));
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
  command.set_work([&context, arguments] {
    context.comm.together([&] {  // only the root rank works; its exit status becomes that of every rank
      if (context.comm.is_root()) check_on_root(context, *arguments);
    });
  });
}

}  // namespace quadloop::app
