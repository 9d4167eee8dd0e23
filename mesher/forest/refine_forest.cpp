#include "mesher/forest/refine_forest.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr int levels_between_partitions = 3;

/// Flags for the local leaves that have finer neighbours on opposite sides.
std::vector<char> squeezed_leaves(const LeafGraph& graph) {
  std::vector<char> marked;
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    const unsigned finer = graph.around(leaf).finer;
    marked.push_back((finer & (finer >> 2)) != 0);
  }
  return marked;
}

std::vector<int> weights_of(const Forest& forest, SizeTree& sizes) {
  std::vector<int> weights;
  weights.reserve(static_cast<std::size_t>(forest.local_leaves()));
  for (const Quadrant& q : forest.leaves()) weights.push_back(sizes.segments_in(q).empty() ? weight_uncut : weight_cut);
  return weights;
}

}  // namespace

LeafGraph refine_forest(const Communicator& comm, SizeTree& sizes) {
  Forest forest(comm, sizes.lattice());
  const int finest = sizes.finest_level();
  // A few levels at a time, so that no rank makes a branch alone.
  const int step = comm.size() == 1 ? finest : levels_between_partitions;
  for (int level = 1; level < finest; level += step) {
    forest.refine([&](const Quadrant& q) { return q.level >= level && sizes.must_split(q); }, std::min(level + step, finest));
    if (comm.size() > 1) forest.partition(level + step >= finest ? weights_of(forest, sizes) : std::vector<int>{});
  }
  while (true) {
    LeafGraph graph(comm, sizes.lattice(), forest);
    const std::vector<char> marked = squeezed_leaves(graph);
    if (!comm.any(std::find(marked.begin(), marked.end(), 1) != marked.end())) return graph;
    forest.split_marked(marked);
  }
}

}  // namespace quadloop
