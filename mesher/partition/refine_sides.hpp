#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace quadloop {

/// A graph whose nodes belong to one of two sides: 0 or 1.
struct WeightedGraph {
  struct Neighbour {
    std::int32_t node = 0;
    std::int32_t weight = 1;  ///< of the edge
  };

  std::vector<std::int64_t> weights;  ///< of nodes
  std::vector<char> sides;            ///< of nodes
  std::vector<std::array<std::int64_t, 2>>
      fixed;                         ///< of each node: weight of its edges to what stays on a side
  std::vector<std::int64_t> starts;  ///< the neighbours of node i: from starts[i] to starts[i + 1]
  std::vector<Neighbour> neighbours;

  std::int32_t size() const { return static_cast<std::int32_t>(weights.size()); }
};

/// The weight of either side, with what stays on it, and the bounds of both.
struct SideWeights {
  std::array<std::int64_t, 2> sides = {};
  std::int64_t least = 0, most = 0;
};

/// Moves nodes between the two sides so that less weight of edges lies between them: passes of Fiduccia and
/// Mattheyses ("A linear-time heuristic for improving network partitions", DAC 1982), in which each node
/// moves at most once, the best first, also where that makes things worse, and the best state on the way is
/// kept; on a sequence of graphs coarsened by heavy-edge matching, from the coarsest to the finest (Karypis
/// and Kumar, SIAM J. Sci. Comput. 20, 1998). No side leaves the bounds, where both begin within them. The
/// result follows from the numbers of the nodes alone. O(n log n) in time.
void refine_sides(WeightedGraph& graph, SideWeights& weights);

}  // namespace quadloop
