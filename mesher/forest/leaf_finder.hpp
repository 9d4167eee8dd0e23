#pragma once

#include <array>
#include <cstdint>

#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Finds leaves by position. Consecutive queries of nearby positions are fast, as the path to the last leaf
/// is kept.
class LeafFinder {
 public:
  /// `graph` must outlive it.
  explicit LeafFinder(const LeafGraph& graph) : graph_{graph} {}

  const LeafGraph& graph() const { return graph_; }
  /// Same as LeafGraph::leaf_at.
  LeafId leaf_at(std::int64_t x, std::int64_t y);
  /// The leaves around a grid vertex, in the order of Corner; a leaf with the vertex on one of its sides
  /// occurs twice.
  std::array<LeafId, 4> leaves_round(GridPoint p) {
    return {leaf_at(p.x - 1, p.y - 1), leaf_at(p.x, p.y - 1), leaf_at(p.x, p.y), leaf_at(p.x - 1, p.y)};
  }

 private:
  const LeafGraph& graph_;
  std::int64_t x_ = -1, y_ = -1;  ///< unit square of the last query, initially outside the root
  int depth_ = 0;                 ///< level of the result
  std::array<LeafGraph::Ref, Quadrant::unit_level + 1> path_{};  ///< from the root to the result
};

}  // namespace quadloop
