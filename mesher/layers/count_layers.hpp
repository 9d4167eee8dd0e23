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

/// Bounds of the number of nodes that add_layers() and add_strips() would add to a mesh of the front's outer
/// geometry. `least`: all columns of a fan merge at once; `most`: none merge. *Collective.*
NodeBounds layer_nodes(const Communicator& comm, const LayerFront& front, const Mesh& outer);

}  // namespace quadloop
