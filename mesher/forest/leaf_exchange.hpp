#pragma once

#include <cstdint>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

/// Sends to each rank the owners' data of its ghost leaves; rows have one entry per leaf of the graph.
class LeafExchange : public GhostExchange {
 public:
  /// *Collective.*
  LeafExchange(const Communicator& comm, const LeafGraph& graph);
};

/// Calls `visit` for the leaves that touch a leaf by an edge or a corner, for some more than once. Touching
/// leaves must differ by at most one level.
template <class Visit>
void for_touching_leaves(LeafFinder& finder, LeafId leaf, const Visit& visit) {
  const LeafGraph::Around& around = finder.graph().around(leaf);
  const Quadrant& q = finder.graph().leaf(leaf);
  const std::int64_t right = q.x + q.size(), top = q.y + q.size();
  const auto visit_any = [&](LeafId other) {
    if (other != LeafGraph::none) visit(other);
  };
  const auto visit_at = [&](std::int64_t x, std::int64_t y) { visit_any(finder.leaf_at(x, y)); };
  for (const LeafId other :
       {around.south_west, around.south, around.south_half, around.west, around.west_half})
    visit_any(other);
  visit_at(right, q.y - 1);
  visit_at(right, q.y);
  if (around.finer.contains(Side::right)) visit_at(right, top - 1);
  visit_at(right, top);
  if (around.finer.contains(Side::top)) visit_at(right - 1, top);
  visit_at(q.x, top);
  visit_at(q.x - 1, top);
}

}  // namespace quadloop
