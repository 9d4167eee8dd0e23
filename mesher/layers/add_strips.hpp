#pragma once

#include <vector>

#include "mesher/layers/add_layers.hpp"

namespace quadloop {

/// Fills the strips of wakes and free lines: columns across the line, and triangles between their last rows
/// and the nodes on the strip's front. Call after add_layers: wakes continue the columns made there. New
/// nodes are numbered after nodes on the front; new cells belong to the leaves of the front's edges. Removes
/// the strips' boundary from the mesh and adds their layers by name (Mesh::strips). Throws InputError with
/// coordinates for a cell without positive area. *Collective.*
void add_strips(const Communicator& comm, const LayerFront& front,
                const std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves);

}  // namespace quadloop
