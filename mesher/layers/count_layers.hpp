#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Bounds of a number of nodes.
struct NodeBounds {
  std::int64_t least = 0, most = 0;
};

/// How many nodes add_layers() and add_strips() would add to a mesh of the front's outer outline. At least:
/// if all columns of a fan merged at once; at most: if none did. *Collective.*
NodeBounds layer_nodes(const Communicator& comm, const LayerFront& front, const Mesh& outer);

}  // namespace quadloop
