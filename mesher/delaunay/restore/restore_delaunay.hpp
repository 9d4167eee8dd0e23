#pragma once

#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Flips edges of a mesh of triangles until it is constrained Delaunay; edges with one triangle over all
/// ranks stay. Both ends of an edge that may not be Delaunay are among the `nodes`, of which any rank may
/// name any. `rank_of` is a strict order of positions; no triangle may be
/// inverted or flat. *Collective.*
///
/// The triangles and their order do not depend on the number of ranks. Triangles that stay keep their slots
/// in the global order, new ones get those that become free. Points keep their numbers; copies of nodes that
/// new triangles have are appended, and copies of no further use stay. Where there are several blocks,
/// `triangle_to_block` has an entry for each of this rank's triangles: edges between two blocks stay, and
/// each slot keeps its block. Any distributed mesh will do. But for a look at each triangle, work and
/// messages grow with the number of `nodes`.
void restore_delaunay_at(const Communicator& comm, Mesh& mesh, std::vector<GlobalNodeId> nodes,
                         const std::function<TieRank(Point)>& rank_of,
                         const std::vector<std::int32_t>& triangle_to_block = {});

/// The same after nodes have moved. `moved` has a flag for each of the mesh's points, owned and copies, the
/// same on every rank. Before they moved the mesh was constrained Delaunay, or all flags are set. Of four
/// nodes on one circle those that have not moved keep their diagonal; of others it is chosen by `rank_of`.
/// *Collective.*
void restore_delaunay(const Communicator& comm, Mesh& mesh, const NodeFlags& moved,
                      const std::function<TieRank(Point)>& rank_of,
                      const std::vector<std::int32_t>& triangle_to_block = {});

/// The same for a mesh of one block, but a new triangle stands where a triangle that is gone stood, one that
/// shares its first node and is nearest to it, so that what was known of places holds for their
/// neighbourhood. Returns, for each of this rank's triangles before, how many stand in its slot: 1 for those
/// that stay. *Collective.*
std::vector<std::int32_t> restore_delaunay_nearby(const Communicator& comm, Mesh& mesh,
                                                  const NodeFlags& moved,
                                                  const std::function<TieRank(Point)>& rank_of);

}  // namespace quadloop
