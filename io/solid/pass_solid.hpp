#pragma once

#include "io/files/reading/value_pipe.hpp"
#include "io/loaded/pass_mesh.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

template <class Pipe>
void pass_fields(Pipe& pipe, SolidPatch& patch) {
  pass(pipe, patch.name, patch.condition, patch.faces, patch.is_empty, patch.is_periodic);
}

template <class Pipe>
void pass_fields(Pipe& pipe, SolidMesh& mesh) {
  pass(pipe, mesh.points, mesh.tetrahedra, mesh.pyramids, mesh.prisms, mesh.hexahedra, mesh.patches,
       mesh.solution, mesh.block_names, mesh.cell_to_block, mesh.warnings);
}

}  // namespace quadloop
