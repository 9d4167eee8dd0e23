#pragma once

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// Flags the nodes that cells of two blocks share.
NodeFlags interface_nodes(const LoadedMesh& loaded);

/// These, and nodes at the same place as another, on the two sides of a crack: they must not part. Empty
/// where there are none.
NodeFlags nodes_that_stay(const LoadedMesh& loaded);

}  // namespace quadloop
