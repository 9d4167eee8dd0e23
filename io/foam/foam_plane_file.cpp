#include "io/foam/foam_plane_file.hpp"

#include <set>

#include "io/foam/foam_file.hpp"
#include "io/loaded/foreign_mesh.hpp"
#include "io/solid/require_conforming.hpp"
#include "io/solid/solid_blocks.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/solid/extruded_mesh.hpp"
#include "mesher/solid/plane_of_solid.hpp"

namespace quadloop {

namespace {

/// Without the boundary edges that have cells on both sides. *Collective.*
Mesh without_interfaces(const Communicator& comm, const Mesh& mesh) {
  Mesh result = mesh;
  for (BoundaryEdges& boundary : result.boundaries) {
    for (auto& [from, to] : boundary.edges) std::swap(from, to);
  }
  const std::vector<std::int64_t> right = edge_cells(comm, result).of_boundary;
  auto at = right.begin();
  for (std::size_t b = 0; b < result.boundaries.size(); ++b) {
    auto& edges = result.boundaries[b].edges;
    edges.clear();
    for (const auto& edge : mesh.boundaries[b].edges) {
      if (*at++ == EdgeCells::none) edges.push_back(edge);
    }
  }
  return result;
}

void write(OutputSet& outputs, const Mesh& mesh, const std::string& path, const PlaneBlocks* blocks) {
  const Communicator& comm = outputs.communicator();
  const Mesh plane = without_interfaces(comm, mesh);
  require_conforming(comm, plane, edge_cells(comm, plane), 0, path);
  ExtrudedMesh layer = extruded(plane, even_heights(1, 1), ExtrusionAxis::z);
  layer.blocks = blocks;
  write_foam(outputs, SolidStream(comm, layer), path);
}

}  // namespace

void write_foam_plane(OutputSet& outputs, const Mesh& mesh, const std::string& path) {
  write(outputs, mesh, path, nullptr);
}

void write_foam_plane(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  const PlaneBlocks blocks = plane_blocks(whole);
  write(outputs, whole.mesh, path, whole.blocks > 1 ? &blocks : nullptr);
}

LoadedMesh read_foam_plane(const std::string& path) {
  const std::optional<SolidMesh> solid = read_foam(path);
  if (!is_one_cell_thick(*solid))
    throw InputError(path +
                     ": holds a 3D mesh: none of its patches is of the type empty, between which a plane "
                     "mesh is one cell thick");
  return loaded_plane(*solid, path);
}

namespace {

/// Those of the prisms and hexahedra; a plane mesh has the cells of a block one after another.
void take_blocks(LoadedMesh& loaded, const SolidMesh& solid) {
  if (solid.block_names.size() < 2) return;
  loaded.blocks = static_cast<std::int32_t>(solid.block_names.size());
  loaded.block_names = solid.block_names;
  const auto quads = solid.cell_to_block.begin() + std::ssize(loaded.mesh.triangles);
  loaded.triangle_to_block.assign(solid.cell_to_block.begin(), quads);
  loaded.quad_to_block.assign(quads, solid.cell_to_block.end());
  order_by_blocks(loaded);
}

void mark_periodic(LoadedMesh& loaded, const SolidMesh& solid) {
  std::set<std::string> names;
  for (const SolidPatch& patch : solid.patches) {
    if (patch.is_periodic) names.insert(patch.name);
  }
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) {
    if (!names.contains(boundary.name)) continue;
    for (const auto& [from, to] : boundary.edges)
      loaded.periodic_nodes.insert(loaded.periodic_nodes.end(), {from, to});
  }
}

}  // namespace

LoadedMesh loaded_plane(const SolidMesh& solid, const std::string& path) {
  LoadedMesh loaded;
  PlaneOfSolid plane = plane_of_solid(solid, path);
  loaded.mesh = std::move(plane.mesh);
  loaded.solution = std::move(plane.solution);
  loaded.triangle_to_block.assign(loaded.mesh.triangles.size(), 0);
  loaded.quad_to_block.assign(loaded.mesh.quads.size(), 0);
  loaded.block_names = {"domain"};
  take_blocks(loaded, solid);
  mark_periodic(loaded, solid);
  loaded.warnings = solid.warnings;
  return loaded;
}

}  // namespace quadloop
