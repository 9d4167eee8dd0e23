#include "mesher/forest/refine_forest.hpp"

#include <algorithm>
#include <array>

#include "mesher/base/progress.hpp"
#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t leaves_to_share = 64;    ///< for each rank, before the first partition
constexpr std::int64_t leaves_to_judge = 4096;  ///< for each rank: enough to estimate the leaves to come well
constexpr double quadrants_of_leaf = 4.0 / 3;   ///< leaves and what was split into them
constexpr int last_levels = 3;  ///< refined after the second partition, where such an estimate cannot be had
constexpr int weight_unfinished = 16;  ///< of a leaf that is yet to be split, down those levels

/// Finds the leaves that have finer neighbours on opposite sides, and those that get them when these are
/// split.
class SqueezedLeaves {
 public:
  explicit SqueezedLeaves(const LeafGraph& graph) : graph_{graph} {
    for (const LeafId leaf : graph.local()) finer_.push_back(graph.around(leaf).finer);
    marked_.assign(finer_.size(), 0);
    for (const LeafId leaf : graph.local()) mark(leaf);
    while (!waiting_.empty()) {
      const LeafId leaf = waiting_.back();
      waiting_.pop_back();
      tell_neighbours(leaf);
    }
  }

  bool any() const { return any_; }
  /// A flag for each local leaf.
  const std::vector<char>& marked() const { return marked_; }

 private:
  std::int32_t local(LeafId leaf) const { return graph_.local_index(leaf); }

  void mark(LeafId leaf) {
    if (!finer_[local(leaf)].has_opposites() || marked_[local(leaf)] != 0) return;
    marked_[local(leaf)] = 1;
    any_ = true;
    waiting_.push_back(leaf);
  }

  /// A leaf as large as the one that splits gets a finer neighbour.
  void tell_neighbours(LeafId leaf) {
    const Quadrant& q = graph_.leaf(leaf);
    const std::int64_t s = q.size();
    const std::array<LeafId, 4> across{graph_.leaf_at(q.x, q.y - 1), graph_.leaf_at(q.x + s, q.y),
                                       graph_.leaf_at(q.x, q.y + s), graph_.leaf_at(q.x - 1, q.y)};
    for (const Side side : all_sides) {
      const LeafId neighbour = across[index_of(side)];
      if (neighbour == LeafGraph::none || !graph_.is_local(neighbour) ||
          graph_.leaf(neighbour).level != q.level)
        continue;
      finer_[local(neighbour)].add(opposite(side));
      mark(neighbour);
    }
  }

  const LeafGraph& graph_;
  std::vector<SideSet> finer_;
  std::vector<char> marked_;
  std::vector<LeafId> waiting_;
  bool any_ = false;
};

/// The level of a uniform tree with at least so many leaves.
int level_with(std::int64_t leaves) {
  int level = 1;
  while (level < Quadrant::unit_level && (std::int64_t{1} << (2 * level)) < leaves) ++level;
  return level;
}

/// The levels down to which the forest is refined before the leaves are shared out anew. Passes over finished
/// leaves cost, so there are few.
std::vector<int> stops_of(const Communicator& comm, const SizeTree& sizes) {
  const int finest = sizes.finest_level();
  if (comm.size() == 1) return {finest};
  const int first = std::min(finest, level_with(leaves_to_share * comm.size())),
            judged = level_with(leaves_to_judge * comm.size());
  std::vector<int> stops{first};
  const int last = judged < sizes.coarsest_level() ? judged : finest - last_levels;
  if (last > first) stops.push_back(last);
  if (finest > first) stops.push_back(finest);
  return stops;
}

/// An estimate of the leaves that a quadrant will hold, in the end, for each that it holds where there is no
/// outline: those as large as any may be, and about `leaves_across` of each finer size beside the outline.
int leaves_to_come(const Quadrant& q, const SizeTree& sizes, SizeCursor& cursor) {
  constexpr int leaves_across = 4, deepest = 12;
  if (cursor.segments_in(q).empty()) return 1;
  return 1 + (leaves_across << std::min(sizes.finest_level() - q.level, deepest)) /
                 (1 << 2 * std::clamp(sizes.coarsest_level() - q.level, 0, deepest));
}

/// The weight of a leaf when the leaves are shared out at a stop: at the last one by the work of cutting,
/// before by the leaves still to come.
int weight_at(const Quadrant& q, const SizeTree& sizes, SizeCursor& cursor, Gradation& gradation, int stop) {
  if (stop == sizes.finest_level()) return cursor.segments_in(q).empty() ? weight_uncut : weight_cut;
  if (stop < sizes.coarsest_level()) return leaves_to_come(q, sizes, cursor);
  return q.level == stop && gradation.must_split(q) ? weight_unfinished : 1;
}

}  // namespace

LeafGraph refine_forest(const Communicator& comm, const SizeTree& sizes, double expected_leaves) {
  SizeCursor cursor(sizes);
  Gradation gradation(sizes);
  Forest forest(comm, sizes.lattice());
  progress::Stage stage("refinement", expected_leaves * quadrants_of_leaf / comm.size(), "quadrants");
  double looked_at = 0;
  int refined = 1;
  for (const int stop : stops_of(comm, sizes)) {
    const auto must_split = [&](const Quadrant& q) {
      if (q.level < refined) return false;
      stage.advance(++looked_at);
      return gradation.must_split(q);
    };
    forest.refine(must_split, stop);
    const auto weight = [&](const Quadrant& q) { return weight_at(q, sizes, cursor, gradation, stop); };
    if (comm.size() > 1) forest.partition(weight);
    refined = stop;
  }
  while (true) {
    LeafGraph graph(comm, sizes.lattice(), forest);
    const SqueezedLeaves squeezed(graph);
    if (!comm.any(squeezed.any())) return graph;
    forest.split_marked(squeezed.marked());
  }
}

}  // namespace quadloop
