#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::smoother {

/// The geometry with the chords of its curves as segments.
Geometry chords_of(const Geometry& geometry);

/// Moves the boundary nodes of a mesh from the chords of the geometry's curves, where cutting places them,
/// onto the curves. Returns flags of the owned nodes and ghosts that have moved; empty if the geometry has no
/// curves. *Collective.*
NodeFlags move_nodes_to_curves(const Communicator& comm, const Geometry& geometry, Mesh& mesh);

}  // namespace quadloop::smoother
