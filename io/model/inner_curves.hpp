#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

/// Moves the boundary edges inside a block to inner curves of the same names, with a warning that names them;
/// boundaries without other edges are removed. `table` has the edges of the mesh, which is whole on this
/// rank.
void separate_inner_curves(LoadedMesh& loaded, const EdgeTable& table, const std::string& path);

/// The same for a distributed mesh of one block. *Collective.*
void separate_inner_curves(const Communicator& comm, LoadedMesh& loaded, const std::string& path);

/// Removes boundaries without edges on any rank. *Collective.*
void drop_empty_boundaries(const Communicator& comm, Mesh& mesh);

}  // namespace quadloop::io
