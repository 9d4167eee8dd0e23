#pragma once

#include <optional>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The geometry with shorter chords at the inverted cells of a mesh whose nodes have moved from the chords of
/// curves onto the curves; none if no cell near a curve is inverted. *Collective.*
std::optional<Geometry> nearer_chords(const Communicator& comm, const Geometry& geometry, const Mesh& mesh);

}  // namespace quadloop
