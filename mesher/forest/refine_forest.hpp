#pragma once

#include "mesher/forest/forest.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// The work of a leaf in the partition's units: one that holds geometry takes about so many times one that
/// does not.
constexpr int weight_uncut = 1, weight_cut = 16;

/// The smallest forest that the size tree allows and in which no leaf lies between two finer ones on opposite
/// sides (thesis Fig. 3.4 (a)), so that a leaf has at most two hanging nodes, on adjacent sides. The leaves
/// are shared out by weight. Returns the leaves of this rank and those around them. *Collective.*
/// `expected_leaves`, over all ranks, are for the line of progress alone; 0: not known.
LeafGraph refine_forest(const Communicator& comm, const SizeTree& sizes, double expected_leaves = 0);

}  // namespace quadloop
