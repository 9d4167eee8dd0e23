#pragma once

#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Flips edges of a mesh of triangles until it is constrained Delaunay; edges with one triangle over all
/// ranks are kept. Both ends of each edge that may not be Delaunay must be among `nodes`; any rank may list
/// any node. `rank_of` is a strict order of positions. No triangle may be inverted or flat. *Collective.*
///
/// The triangles and their order do not depend on the number of ranks. Unchanged triangles keep their slots
/// in the global order; new ones take the freed slots. Points keep their numbers; ghost copies needed by new
/// triangles are appended, and unused copies remain. With several blocks `triangle_to_block` has an entry for
/// each of this rank's triangles: edges between two blocks are kept, and each slot keeps its block. Any
/// distribution of the mesh is allowed. Apart from one pass over the triangles, work and communication grow
/// with the number of `nodes`.
void restore_delaunay_at(const Communicator& comm, Mesh& mesh, std::vector<GlobalNodeId> nodes,
                         const std::function<TieRank(Point)>& rank_of,
                         const std::vector<std::int32_t>& triangle_to_block = {});

/// Same after nodes have moved. `moved` has a flag for each of the mesh's points, ghost copies included, with
/// the same value on every rank. Before the move the mesh was constrained Delaunay, or all flags are set.
/// Four unmoved nodes on one circle keep their diagonal; other ties are decided by `rank_of`. *Collective.*
void restore_delaunay(const Communicator& comm, Mesh& mesh, const NodeFlags& moved,
                      const std::function<TieRank(Point)>& rank_of,
                      const std::vector<std::int32_t>& triangle_to_block = {});

/// Same for a mesh of one block, but a new triangle takes the place of the nearest removed triangle that
/// shares its first node, so that triangle order stays local. Returns for each of this rank's previous
/// triangles the number of triangles now in its slot: 1 for unchanged ones. *Collective.*
std::vector<std::int32_t> restore_delaunay_nearby(const Communicator& comm, Mesh& mesh,
                                                  const NodeFlags& moved,
                                                  const std::function<TieRank(Point)>& rank_of);

}  // namespace quadloop
