#pragma once

#include "mesher/forest/forest.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/sizes/leaf_estimate.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Weights of leaves in the partition: a leaf with geometry takes about 16 times as much work as one without.
constexpr int weight_uncut = 1, weight_cut = 16;

/// The smallest forest that the size tree allows in the domain and in which leaves that touch differ by one
/// level at most and no leaf lies between two finer ones on opposite sides (thesis Fig. 3.4 (a)), so that a
/// leaf has at most two hanging nodes, on adjacent sides. Outside the domain sizes ask for nothing. The
/// leaves are shared out by weight: no rank has a fiftieth more than others, about. Returns the leaves of
/// this rank and those around them. *Collective.* `expected` is for the line of progress, and for shares of
/// the work before the leaves are there; no leaf depends on it, and there may be none.
LeafGraph refine_forest(const Communicator& comm, SizeTree& sizes, const LeafEstimate& expected = {});

}  // namespace quadloop
