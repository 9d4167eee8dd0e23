#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/sizes/leaf_sample.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// How many leaves a forest will have. Not whole numbers: they come from a sample.
struct LeafEstimate {
  double cut = 0;      ///< that hold outline
  double inside = 0;   ///< others in the domain
  double outside = 0;  ///< the rest
  LeafSample sample;   ///< where they are
  double all() const { return cut + inside + outside; }
};

/// Estimates the leaves of the forest that the size tree leads to, without making it: of the quadrants that
/// are to be split on each level only some hundreds are followed, more of them where more leaves are to be
/// expected, each for as many others as its chance says. A forest with fewer is counted, but for what is
/// split outside the domain, which is guessed by the cut leaves. Time grows with the levels, not with the
/// leaves. The same on any number of ranks; not collective.
LeafEstimate estimate_leaves(SizeTree& sizes);

/// The same to the last bit, in less time: each rank looks at some of the quadrants. *Collective.*
LeafEstimate estimate_leaves(const Communicator& comm, SizeTree& sizes);

}  // namespace quadloop
