#pragma once

#include "io/files/value_pipe.hpp"
#include "io/loaded/loaded_mesh.hpp"

namespace quadloop {

template <class Pipe>
void pass_fields(Pipe& pipe, BoundaryEdges& boundary) {
  pass(pipe, boundary.name);
  pass(pipe, boundary.condition);
  pass(pipe, boundary.edges);
}

/// A whole mesh: without copies of other ranks' nodes.
template <class Pipe>
void pass_fields(Pipe& pipe, Mesh& mesh) {
  pass(pipe, mesh.points);
  pass(pipe, mesh.owned_nodes);
  pass(pipe, mesh.triangles);
  pass(pipe, mesh.quads);
  pass(pipe, mesh.boundaries);
}

template <class Pipe>
void pass_fields(Pipe& pipe, Field& solution) {
  pass(pipe, solution.constants);
  pass(pipe, solution.names);
  pass(pipe, solution.values);
}

template <class Pipe>
void pass_fields(Pipe& pipe, LoadedMesh& loaded) {
  pass(pipe, loaded.mesh);
  pass(pipe, loaded.blocks);
  pass(pipe, loaded.triangle_to_block);
  pass(pipe, loaded.quad_to_block);
  pass(pipe, loaded.block_names);
  pass(pipe, loaded.solution);
  pass(pipe, loaded.warnings);
}

}  // namespace quadloop
