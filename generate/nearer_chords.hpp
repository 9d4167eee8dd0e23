#pragma once

#include <optional>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The geometry with shorter chords at the inverted cells of a mesh whose nodes have moved from the chords of
/// curves onto the curves; none if no cell near a curve is inverted. *Collective.*
std::optional<Geometry> nearer_chords(const Communicator& comm, const Geometry& geometry, const Mesh& mesh);

/// Throws InputError on all ranks, with place and remedy, if the geometry has curves and a cell of the mesh
/// is inverted or flat. *Collective.*
void require_not_inverted(const Communicator& comm, const Geometry& geometry, const Mesh& mesh);

}  // namespace quadloop
