#pragma once

#include <array>
#include <cstdint>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

/// Brings to each rank what the owners of its ghost leaves know of them: rows have one entry for each leaf of
/// the graph.
class GhostExchange : public CopyExchange {
 public:
  /// *Collective.*
  GhostExchange(const Communicator& comm, const LeafGraph& graph);
};

/// Calls `visit` for the leaves of the graph that touch a leaf, by an edge or a corner; for some of them more
/// than once. Touching leaves must differ by one level at most.
template <class Visit>
void for_touching_leaves(LeafFinder& finder, LeafId leaf, const Visit& visit) {
  const Quadrant& q = finder.graph().leaf(leaf);
  const std::int64_t last = q.size() - 1, x = q.x, y = q.y;
  const std::array<std::array<std::int64_t, 2>, 12> squares{{{x - 1, y - 1},
                                                             {x, y - 1},
                                                             {x + last, y - 1},
                                                             {x + last + 1, y - 1},
                                                             {x + last + 1, y},
                                                             {x + last + 1, y + last},
                                                             {x + last + 1, y + last + 1},
                                                             {x + last, y + last + 1},
                                                             {x, y + last + 1},
                                                             {x - 1, y + last + 1},
                                                             {x - 1, y + last},
                                                             {x - 1, y}}};
  for (const auto& [px, py] : squares) {
    const LeafId other = finder.leaf_at(px, py);
    if (other != LeafGraph::none) visit(other);
  }
}

}  // namespace quadloop
