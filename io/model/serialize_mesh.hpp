#pragma once

#include <cstdint>
#include <string>

#include "io/files/reading/value_pipe.hpp"
#include "io/model/file_mesh.hpp"

namespace quadloop::io {

template <class Pipe>
void pass_fields(Pipe& pipe, StripLayers& strip) {
  pass(pipe, strip.name, strip.layers, strip.from_wall, strip.across, strip.nodes);
}

template <class Pipe>
void pass_fields(Pipe& pipe, PeriodicPair& pair) {
  pass(pipe, pair.from, pair.to, pair.translation, pair.degrees, pair.centre);
}

template <class Pipe>
void pass_fields(Pipe& pipe, NamedNode& named) {
  pass(pipe, named.name, named.node);
}

template <class Pipe>
void pass_fields(Pipe& pipe, Field& solution) {
  pass(pipe, solution.constants, solution.names, solution.values, solution.cells.names,
       solution.cells.values);
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
       mesh.strips, mesh.pairs, mesh.named_nodes, mesh.warnings);
  for (std::vector<std::int32_t>& blocks : mesh.cell_to_block) pass(pipe, blocks);
}

/// Throws InputError if a mesh received through a pipe refers to a node or a block that does not exist, or if
/// its numbers of values do not match those of nodes and cells: a damaged file may have corrupted the process
/// that read it.
void require_consistent(const FileMesh& mesh, const std::string& path);

/// Whether a mesh refers only to the nodes 0 to `nodes - 1`.
bool refers_to_nodes(const FileMesh& mesh, std::int64_t nodes);

}  // namespace quadloop::io
