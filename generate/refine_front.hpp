#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Where layers cannot stand on this mesh outside of the front (unsound_strips), asks for more of the next
/// one: the stations that a chord passes over become nodes, and leaves there are split until they
/// can be told apart, also below spacing.min, by a factor of four at most. Whether there is such a place.
/// *Collective.*
bool refine_front(const Communicator& comm, const Lattice& lattice, const MeshResult& outside,
                  LayerFront& front, DemandedSplits& splits);

/// The nodes of all such places. *Collective.*
std::vector<GlobalNodeId> unsound_nodes(const Communicator& comm, const LayerFront& front,
                                        const MeshResult& outside);

/// The tree record tells what adaptation has asked for and no more: the same mesh is made again from that.
void forget_splits(const DemandedSplits& adapted, TreeRecord& tree);

}  // namespace quadloop
