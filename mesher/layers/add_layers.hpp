#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/layers/grown_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Fills the strip between the walls and the layer front with columns of layer cells, one column per node of
/// the front. A column's nodes follow its front node in the numbering, from the wall outwards. Its cells
/// belong to the leaf of the front edge before it and follow the leaf's own cells; `leaves` count them.
/// `edge_leaves` is as in MeshResult, before and after. If `divide` is set, quadrilaterals are divided by
/// their shorter diagonal, or, if both are equal, by the one through the front node of the higher rank in
/// that order. Throws InputError with coordinates for a cell without positive area. *Collective.*
void add_layers(const Communicator& comm, const LayerFront& front,
                std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves);

}  // namespace quadloop
