#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Converts a distributed mesh of one block, as in its file, to the program's conventions: does what
/// plane_mesh() does with a whole mesh that has no cells to reverse. Throws an InputError on all ranks if
/// there may be some, if an edge belongs to no cell, or if there is no boundary. *Collective.*
void complete_plane_part(const Communicator& comm, LoadedMesh& loaded, const std::string& path);

}  // namespace quadloop::io
