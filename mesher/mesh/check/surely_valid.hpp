#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Whether validate() of the whole mesh certainly finds no error, for a distributed mesh of one block without
/// inner lines among its boundaries, of which the root gets the boundary edges only. False, too, if this
/// cannot be decided so: for several blocks, cracks, and nodes where the boundary passes more than once. The
/// rules are those of require_sound(): with each edge used as it must be, positive cells, and boundary edges
/// that do not meet, each point is covered as often as the boundary winds around it, which is checked on both
/// sides of the boundary. O(n) apart from the boundary. *Collective.*
bool is_surely_valid(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
