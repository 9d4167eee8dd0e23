#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Refines the next mesh where layers are not valid on this mesh outside the outer edge (unsound_strips):
/// stations that a chord skips become nodes, and quadtree cells there are split until they separate the
/// stations, below spacing.min if necessary, by a factor of four at most. Returns whether there is such a
/// location. *Collective.*
bool refine_front(const Communicator& comm, const TreeGrid& grid, const MeshResult& outside,
                  LayerFront& front, DemandedSplits& splits);

/// Returns the nodes of all such locations. *Collective.*
std::vector<GlobalNodeId> unsound_nodes(const Communicator& comm, const LayerFront& front,
                                        const MeshResult& outside);

/// Restores the adaptation splits in the tree record, so that the same mesh can be generated again from it.
void forget_splits(const DemandedSplits& adapted, TreeRecord& tree);

}  // namespace quadloop
