#pragma once

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Distributes a mesh that is whole on the root, in its own order: an even share of nodes, triangles, quads
/// and edges to each rank. *Collective.*
LoadedMesh distributed(const Communicator& comm, LoadedMesh whole);

/// Returns a distributed mesh whole on the root, in its own order; on the other ranks one without nodes, with
/// the same names. *Collective.*
LoadedMesh gathered(const Communicator& comm, const LoadedMesh& part);

}  // namespace quadloop::io
