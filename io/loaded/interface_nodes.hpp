#pragma once

#include "io/loaded/loaded_mesh.hpp"

namespace quadloop {

/// Flags the nodes that cells of two blocks share.
NodeFlags interface_nodes(const LoadedMesh& loaded);

}  // namespace quadloop
