#pragma once

#include <vector>

#include "mesher/layers/add_layers.hpp"

namespace quadloop {

/// Fills the strips of wakes and free lines: columns across them, and triangles between their last rows and
/// the nodes on their fronts. Comes after add_layers, whose columns wakes go on from; nodes and cells stand
/// behind nodes on the front, and with the leaves of its edges. The mesh loses the strips' boundary and gets
/// their layers by name (Mesh::strips). Throws InputError, naming the place, for a cell that is not positive.
/// *Collective.*
void add_strips(const Communicator& comm, const LayerFront& front,
                const std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves);

}  // namespace quadloop
