#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Adds the splits after which the quadtree cells on the two sides of each pair have the same sizes: a cell
/// of which more than half is opposite smaller cells is split. Returns whether there are any. *Collective.*
bool demand_sizes_of_partners(const Communicator& comm, const Geometry& geometry,
                              const std::vector<PeriodicPair>& pairs, const MeshResult& result,
                              DemandedSplits& splits);

/// Makes the nodes on the two sides of each pair match one to one: near nodes move along the boundary to a
/// common place, for others a node is added on the other side. Returns flags of the mesh's points, ghosts
/// included, that moved or were added. Cells stay valid. *Collective.*
NodeFlags match_pairs(const Communicator& comm, const Geometry& geometry,
                      const std::vector<PeriodicPair>& pairs, MeshResult& result);

/// Places the nodes of the second side of each pair exactly at the images of those of the first one.
/// *Collective.*
void place_images(const Communicator& comm, const std::vector<PeriodicPair>& pairs, Mesh& mesh);

}  // namespace quadloop
