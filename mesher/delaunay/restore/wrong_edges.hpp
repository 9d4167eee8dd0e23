#pragma once

#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Of the edges of a mesh of triangles with both ends among `nodes`, of which any rank may name any, those
/// that give way to the other diagonal of their two triangles (should_flip): returns their ends, some
/// more than once, on one rank or several. `moved`, if not empty, has a
/// flag for each of the mesh's points; an edge none of whose four nodes is flagged is not looked at.
/// `rank_of` is a strict order of positions. *Collective.*
std::vector<GlobalNodeId> nodes_of_wrong_edges(const Communicator& comm, const Mesh& mesh,
                                               const std::vector<GlobalNodeId>& nodes, const NodeFlags& moved,
                                               const std::function<TieRank(Point)>& rank_of);

}  // namespace quadloop
