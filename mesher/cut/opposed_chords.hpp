#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Finds opposite chords on the two sides of a leaf side, which result from a spike that was collapsed, and
/// chords there between two blocks without an opposite one.
class OpposedChords {
 public:
  /// *Collective.*
  OpposedChords(const Communicator& comm, const Geometry& geometry, const LeafGraph& graph,
                const CutForest& cut);

  /// The end points of such chords of this rank's leaves, in ascending order.
  const std::vector<Point>& ends() const { return ends_; }
  /// Whether a chord of this rank between two blocks has no opposite one.
  bool sides_differ() const { return sides_differ_; }

 private:
  std::vector<Point> ends_;
  bool sides_differ_ = false;
};

}  // namespace quadloop
