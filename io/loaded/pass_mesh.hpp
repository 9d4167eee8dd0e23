#pragma once

#include "io/files/reading/value_pipe.hpp"
#include "io/loaded/loaded_mesh.hpp"

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

}  // namespace quadloop
