#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace quadloop {

/// A graph whose nodes are on side 0 or 1.
struct WeightedGraph {
  struct Neighbour {
    std::int32_t node = 0;
    std::int32_t weight = 1;  ///< of the edge
  };

  std::vector<std::int64_t> weights;  ///< of the nodes
  std::vector<char> sides;            ///< of the nodes
  /// For each node: weight of its edges to fixed cells on each side.
  std::vector<std::array<std::int64_t, 2>> fixed;
  std::vector<std::int64_t> starts;  ///< the neighbours of node i: from starts[i] to starts[i + 1]
  std::vector<Neighbour> neighbours;

  std::int32_t size() const { return static_cast<std::int32_t>(weights.size()); }
};

/// Weights of both sides, including fixed cells, and their bounds.
struct SideWeights {
  std::array<std::int64_t, 2> sides = {};
  std::int64_t least = 0, most = 0;
};

/// Moves nodes between the two sides to reduce the weight of the edges between them, by passes of Fiduccia
/// and Mattheyses ("A linear-time heuristic for improving network partitions", DAC 1982): each node moves at
/// most once, the best first, even if the cut increases, and the best intermediate state is kept. Applied to
/// a sequence of graphs coarsened by heavy-edge matching, from the coarsest to the finest (Karypis and Kumar,
/// SIAM J. Sci. Comput. 20, 1998). If both sides are within the bounds they stay there. The result depends
/// only on the numbering of the nodes. O(n log n).
void refine_sides(WeightedGraph& graph, SideWeights& weights);

}  // namespace quadloop
