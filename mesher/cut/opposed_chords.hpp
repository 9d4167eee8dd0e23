#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Finds the chords along leaf sides that run against each other on the two sides of it: a spike that was
/// squeezed flat.
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
