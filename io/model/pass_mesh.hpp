#pragma once

#include "io/files/reading/value_pipe.hpp"
#include "io/model/mesh_of_file.hpp"

namespace quadloop {

template <class Pipe>
void pass_fields(Pipe& pipe, BoundaryEdges& boundary) {
  pass(pipe, boundary.name, boundary.condition, boundary.edges, boundary.layers);
}

template <class Pipe>
void pass_fields(Pipe& pipe, StripLayers& strip) {
  pass(pipe, strip.name, strip.layers, strip.from_wall, strip.across, strip.nodes);
}

/// A whole mesh: without copies of other ranks' nodes.
template <class Pipe>
void pass_fields(Pipe& pipe, Mesh& mesh) {
  pass(pipe, mesh.points, mesh.owned_nodes, mesh.triangles, mesh.quads, mesh.boundaries, mesh.strips);
}

template <class Pipe>
void pass_fields(Pipe& pipe, Field& solution) {
  pass(pipe, solution.constants, solution.names, solution.values, solution.cells.names,
       solution.cells.values);
}

template <class Pipe>
void pass_fields(Pipe& pipe, LoadedMesh& loaded) {
  pass(pipe, loaded.mesh, loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block, loaded.block_names,
       loaded.inner_curves, loaded.periodic_nodes, loaded.solution, loaded.warnings);
}

template <class Pipe>
void pass_fields(Pipe& pipe, FileBoundary& boundary) {
  pass(pipe, boundary.name, boundary.condition, boundary.faces, boundary.is_empty, boundary.is_periodic,
       boundary.layers, boundary.places);
}

template <class Pipe>
void pass_fields(Pipe& pipe, FileMesh& mesh) {
  pass(pipe, mesh.dimension, mesh.points, mesh.triangles, mesh.quads, mesh.tetrahedra, mesh.pyramids,
       mesh.prisms, mesh.hexahedra, mesh.boundaries, mesh.solution, mesh.block_names, mesh.periodic_nodes,
       mesh.strips, mesh.warnings);
  for (std::vector<std::int32_t>& blocks : mesh.cell_to_block) pass(pipe, blocks);
}

/// The plane mesh, or the 3D mesh.
template <class Pipe>
void pass_fields(Pipe& pipe, MeshOfFile& mesh) {
  bool is_plane = std::holds_alternative<LoadedMesh>(mesh);
  pass(pipe, is_plane);
  if constexpr (Pipe::reads) {
    if (!is_plane) mesh.emplace<FileMesh>();
  }
  is_plane ? pass(pipe, std::get<LoadedMesh>(mesh)) : pass(pipe, std::get<FileMesh>(mesh));
}

}  // namespace quadloop
