#pragma once

#include "io/files/value_pipe.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

template <class Pipe>
void pass_fields(Pipe& pipe, SolidPatch& patch) {
  pass(pipe, patch.name, patch.condition, patch.faces);
}

template <class Pipe>
void pass_fields(Pipe& pipe, SolidMesh& mesh) {
  pass(pipe, mesh.points, mesh.tetrahedra, mesh.pyramids, mesh.prisms, mesh.hexahedra, mesh.patches,
       mesh.warnings);
}

}  // namespace quadloop
