#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Finds opposite chords on the two sides of a leaf side, which result from a spike that was collapsed.
class OpposedChords {
 public:
  /// *Collective.*
  OpposedChords(const Communicator& comm, const LeafGraph& graph, const CutForest& cut);

  /// The end points of such chords of this rank's leaves, in ascending order.
  const std::vector<Point>& ends() const { return ends_; }

 private:
  std::vector<Point> ends_;
};

}  // namespace quadloop
