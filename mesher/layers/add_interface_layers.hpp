#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/layers/grown_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Adds the layers whose columns stand on nodes of other blocks, after add_layers(). A column's nodes follow
/// its foot in the numbering. Cells belong to the leaf of an edge of the front above them; the last layer
/// consists of triangles. The boundary of these fronts is removed. The arguments are those of add_layers().
/// Throws InputError with coordinates for a cell without positive area. *Collective.*
void add_interface_layers(const Communicator& comm, const LayerFront& front,
                          std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide,
                          Mesh& mesh, std::vector<LeafRecord>& leaves);

}  // namespace quadloop
