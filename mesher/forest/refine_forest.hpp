#pragma once

#include "mesher/forest/forest.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/sizes/leaf_estimate.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Weights of leaves in the partition: a leaf with geometry takes about 16 times as much work as one without.
constexpr int weight_uncut = 1, weight_cut = 16;

/// Builds the smallest forest that satisfies the size tree in the domain, in which touching leaves differ by
/// at most one level and no leaf lies between two finer ones on opposite sides (thesis Fig. 3.4 (a)), so that
/// a leaf has at most two hanging nodes, on adjacent sides. No sizes are prescribed outside the domain.
/// Leaves are partitioned by weight; loads differ by about 2 %. Returns this rank's leaves and their ghosts.
/// *Collective.* `expected` is used for the progress line and for load estimates before the leaves exist; it
/// does not affect the leaves and may be empty.
LeafGraph refine_forest(const Communicator& comm, const SizeTree& sizes, const LeafEstimate& expected = {});

}  // namespace quadloop
