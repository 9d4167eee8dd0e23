#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/layers/grown_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Fills the strip between the walls and the front with columns of layers, one on each node of the front. A
/// column's nodes follow its front node in the numbering, from the wall on; its cells are those of the leaf
/// which the front edge before it belongs to, and stand behind the leaf's own; `leaves` count them.
/// `edge_leaves` are as MeshResult has them, before and after. With a rank of nodes given, quadrilaterals are
/// divided by their shorter diagonals, of equal ones by that through the front node of the higher rank.
/// Throws InputError, naming the place, for a cell that is not positive. *Collective.*
void add_layers(const Communicator& comm, const LayerFront& front,
                std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves);

}  // namespace quadloop
