#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// How many nodes add_layers() and add_strips() would add to a mesh of the front's outer outline, or a few
/// more: columns of a fan are counted as if none of them merged. *Collective.*
std::int64_t most_layer_nodes(const Communicator& comm, const LayerFront& front, const Mesh& outer);

}  // namespace quadloop
