#pragma once

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// Flags the nodes shared by cells of two blocks.
NodeFlags interface_nodes(const LoadedMesh& loaded);

/// Flags these and coincident nodes on the two sides of a crack, which must not separate. Empty if there are
/// none.
NodeFlags nodes_that_stay(const LoadedMesh& loaded);

}  // namespace quadloop::io
