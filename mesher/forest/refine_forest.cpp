#include "mesher/forest/refine_forest.hpp"

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

}  // namespace

Forest refine_forest(const Communicator& comm, SizeTree& sizes) {
  Forest forest(comm, sizes.lattice());
  const auto split = [&](const Quadrant& q) { return sizes.must_split(q); };
  // A few levels at a time, so that no rank makes a branch alone.
  const int step = comm.size() == 1 ? sizes.finest_level() : levels_between_partitions;
  for (int level = 1; level < sizes.finest_level(); level += step) {
    forest.refine(split, std::min(level + step, sizes.finest_level()));
    forest.partition();
  }
  while (true) {
    const std::vector<char> marked = squeezed_leaves(LeafGraph(comm, sizes.lattice(), forest));
    const bool any = std::find(marked.begin(), marked.end(), 1) != marked.end();
    if (!comm.any(any)) break;
    forest.split_marked(marked);
  }
  return forest;
}

}  // namespace quadloop
