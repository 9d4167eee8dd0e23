#pragma once

#include <array>
#include <cstdint>

#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Looks leaves up by a place in them, one after another; few steps each where they lie near each other, as
/// it remembers the way down to the last one.
class LeafFinder {
 public:
  /// `graph` must outlive it.
  explicit LeafFinder(const LeafGraph& graph) : graph_{graph} {}

  const LeafGraph& graph() const { return graph_; }
  /// As LeafGraph::leaf_at.
  LeafId leaf_at(std::int64_t x, std::int64_t y);
  /// The leaves round a lattice point, as Corner counts from it; a leaf that it lies on a side of is there
  /// twice.
  std::array<LeafId, 4> leaves_round(LatticePoint p) {
    return {leaf_at(p.x - 1, p.y - 1), leaf_at(p.x, p.y - 1), leaf_at(p.x, p.y), leaf_at(p.x - 1, p.y)};
  }

 private:
  const LeafGraph& graph_;
  std::int64_t x_ = -1, y_ = -1;  ///< the unit square last looked up, or one outside the root
  int depth_ = 0;                 ///< level of what was found there
  std::array<LeafGraph::Ref, Quadrant::unit_level + 1> path_{};  ///< from the root down to it
};

}  // namespace quadloop
