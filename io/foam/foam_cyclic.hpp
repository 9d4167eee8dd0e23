#pragma once

// For io/foam only.
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Puts the edges of the two boundaries of each pair in one order, as "cyclic" patches require: edge i of one
/// is the partner of edge i of the other. They are then on the first rank. *Collective.*
void order_edges_of_pairs(const Communicator& comm, Mesh& mesh);

}  // namespace quadloop::io
