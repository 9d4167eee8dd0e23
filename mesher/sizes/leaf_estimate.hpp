#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/sizes/leaf_sample.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// Estimated number of leaves of a forest. Not integers, as they are from a sample.
struct LeafEstimate {
  double cut = 0;      ///< with geometry inside
  double inside = 0;   ///< others in the domain
  double outside = 0;  ///< the rest
  LeafSample sample;   ///< their distribution
  double all() const { return cut + inside + outside; }
};

/// Estimates the leaves of the forest that follows from the size tree, without creating it. On each level
/// only some hundreds of the quadrants to be split are followed, with probabilities by their expected leaves,
/// and weighted by the inverse probability. A forest with fewer quadrants is counted exactly, except for the
/// leaves outside the domain, which are estimated from the cut leaves. The time grows with the levels, not
/// with the leaves. Independent of the number of ranks; not collective.
LeafEstimate estimate_leaves(SizeTree& sizes);

/// The same, bitwise, in less time: each rank evaluates some of the quadrants. *Collective.*
LeafEstimate estimate_leaves(const Communicator& comm, SizeTree& sizes);

}  // namespace quadloop
