#include "mesher/forest/refine_forest.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr std::int64_t leaves_to_share = 64;  ///< for each rank, before the first partition
constexpr int last_levels = 3;                ///< refined after the second partition
constexpr int weight_unfinished = 16;         ///< of a leaf that is yet to be split, down those levels

/// Flags for the local leaves that have finer neighbours on opposite sides.
std::vector<char> squeezed_leaves(const LeafGraph& graph) {
  std::vector<char> marked;
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    const unsigned finer = graph.around(leaf).finer;
    marked.push_back((finer & (finer >> 2)) != 0);
  }
  return marked;
}

/// The levels down to which the forest is refined before the leaves are shared out anew. Passes over finished leaves cost, so there are few.
std::vector<int> stops_of(const Communicator& comm, const SizeTree& sizes) {
  const int finest = sizes.finest_level();
  if (comm.size() == 1) return {finest};
  int first = 1;
  while (first < finest && (std::int64_t{1} << (2 * first)) < leaves_to_share * comm.size()) ++first;
  std::vector<int> stops{first};
  if (finest - last_levels > first) stops.push_back(finest - last_levels);
  if (finest > first) stops.push_back(finest);
  return stops;
}

/// The weights for sharing out the leaves at a stop: at the last one by the work of cutting, before by the leaves still to come.
std::vector<int> weights_at(const Forest& forest, SizeTree& sizes, int stop) {
  std::vector<int> weights;
  weights.reserve(static_cast<std::size_t>(forest.local_leaves()));
  for (const Quadrant& q : forest.leaves()) {
    if (stop == sizes.finest_level()) {
      weights.push_back(sizes.segments_in(q).empty() ? weight_uncut : weight_cut);
    } else {
      weights.push_back(q.level == stop && sizes.must_split(q) ? weight_unfinished : 1);
    }
  }
  return weights;
}

}  // namespace

LeafGraph refine_forest(const Communicator& comm, SizeTree& sizes) {
  Forest forest(comm, sizes.lattice());
  int refined = 1;
  for (const int stop : stops_of(comm, sizes)) {
    forest.refine([&](const Quadrant& q) { return q.level >= refined && sizes.must_split(q); }, stop);
    if (comm.size() > 1) forest.partition(weights_at(forest, sizes, stop));
    refined = stop;
  }
  while (true) {
    LeafGraph graph(comm, sizes.lattice(), forest);
    const std::vector<char> marked = squeezed_leaves(graph);
    if (!comm.any(std::find(marked.begin(), marked.end(), 1) != marked.end())) return graph;
    forest.split_marked(marked);
  }
}

}  // namespace quadloop
