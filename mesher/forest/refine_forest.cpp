#include "mesher/forest/refine_forest.hpp"

#include <algorithm>
#include <array>

#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/forest/outside_splits.hpp"
#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

constexpr double quadrants_of_leaf = 4.0 / 3;  ///< all quadrants per leaf
/// Approximate number of quadrants per rank for the initial partition.
constexpr double parts_to_share = 64;
/// Leaves per rank from which on the sample predicts their distribution.
constexpr std::int64_t leaves_to_judge = 4096;
/// Number of levels refined after a second partition if the sample is insufficient.
constexpr int last_levels = 5;
constexpr int weight_unfinished = 64;      ///< of a leaf that may still be split in those levels
constexpr double leaves_to_weigh = 16384;  ///< per rank: this many leaves predict the total weight within 2 %
constexpr double even_enough = 1.02;       ///< below this imbalance moving leaves takes longer than waiting

/// Finds leaves with finer neighbours on opposite sides, and those that get such neighbours when these are
/// split.
class SqueezedLeaves {
 public:
  explicit SqueezedLeaves(const LeafGraph& graph) : graph_{graph}, marked_(graph.local_size()) {
    const auto is_squeezed = [&](LeafId leaf) { return graph.around(leaf).finer.has_opposites(); };
    if (std::ranges::none_of(graph.local(), is_squeezed)) return;
    for (const LeafId leaf : graph.local()) finer_.push_back(graph.around(leaf).finer);
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

  /// Records at the leaf's equally large neighbours that they get a finer neighbour.
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
  std::vector<char> marked_;
  std::vector<SideSet> finer_;  ///< sides with finer neighbours after the splits, for each local leaf
  std::vector<LeafId> waiting_;
  bool any_ = false;
};

/// Decides which quadrants are split by the size field: only those that reach into the domain.
class SizedSplits {
 public:
  explicit SizedSplits(SizeTree& sizes) : gradation_{sizes}, outside_{sizes} {}

  bool must_split(const Quadrant& q) { return gradation_.must_split(q) && outside_.is_split_by_size(q); }
  void split_outside(const Communicator& comm, Forest& forest) { outside_.split(comm, forest); }

 private:
  Gradation gradation_;
  OutsideSplits outside_;
};

/// Before the leaves are there: down to quadrants of about as many each, which are then shared out, so that
/// no two ranks look for the same in the size tree. *Collective.*
void share_out_quadrants(const Communicator& comm, SizeTree& sizes, const LeafSample& sample,
                         SizedSplits& splits, Forest& forest) {
  constexpr double units = 1000, most_parts = 1e6;
  const double part = sample.leaves() / (parts_to_share * comm.size());
  const auto must_split = [&](const Quadrant& q) {
    return sample.leaves_in(q) > part && splits.must_split(q);
  };
  forest.refine(must_split, sizes.finest_level());
  forest.partition([&](const Quadrant& q) {  // not 0, so that quadrants without samples are also partitioned
    return 1 + static_cast<int>(part > 0 ? units * std::min(sample.leaves_in(q) / part, most_parts) : 0);
  });
}

/// Whether leaves are as large as any may be in so much of the root that the sample is right about most.
bool are_leaves_even(const Communicator& comm, SizeTree& sizes) {
  constexpr int deep_enough = 15;
  const int level = std::min(sizes.coarsest_level(), deep_enough);
  return (std::int64_t{1} << (2 * level)) > leaves_to_judge * comm.size();
}

/// Weight by the work of cutting.
int weight_of(const Quadrant& leaf, SizeCursor& cursor) {
  return cursor.segments_in(leaf).empty() ? weight_uncut : weight_cut;
}

/// Total weight of this rank's leaves, estimated from some of them.
class WeighedLeaves {
 public:
  WeighedLeaves(SizeTree& sizes, double expected)
      : cursor_{sizes},
        finest_{sizes.finest_level()},
        step_{1 + static_cast<std::int64_t>(expected / leaves_to_weigh)} {}

  /// Records the result for each quadrant, in the order of the curve. Quadrants of the finest level are not
  /// queried.
  void note(const Quadrant& q, bool is_split) {
    if (!is_split) add(q);
    if (!is_split || q.level + 1 < finest_) return;
    for (const Corner quarter : corners_along_curve) add(q.child(quarter));
  }

  /// *Collective.*
  bool are_shared_evenly(const Communicator& comm) const {
    const auto most = static_cast<double>(comm.maximum(weight_)),
               all = static_cast<double>(comm.sum(weight_));
    return most * comm.size() <= even_enough * all;
  }

 private:
  void add(const Quadrant& leaf) {
    if (count_++ % step_ == 0) weight_ += weight_of(leaf, cursor_);
  }

  SizeCursor cursor_;
  int finest_;
  std::int64_t step_, count_ = 0, weight_ = 0;
};

/// *Collective.*
void share_out_leaves(SizeTree& sizes, Forest& forest) {
  SizeCursor cursor(sizes);
  forest.partition([&](const Quadrant& q) { return weight_of(q, cursor); });
}

}  // namespace

LeafGraph refine_forest(const Communicator& comm, SizeTree& sizes, const LeafEstimate& expected) {
  sizes.expect_cut_leaves(expected.cut / comm.size());
  SizedSplits splits(sizes);
  Forest forest(comm, sizes.grid());
  progress::SharedStage stage(comm, "refinement", expected.all() * quadrants_of_leaf / comm.size(),
                              "quadrants");
  if (comm.size() > 1) share_out_quadrants(comm, sizes, expected.sample, splits, forest);
  double looked_at = 0;
  int refined = 0;
  const auto must_split = [&](const Quadrant& q) {
    if (q.level < refined) return false;
    stage.advance(++looked_at);
    return splits.must_split(q);
  };
  const int finest = sizes.finest_level(), before_last = finest - last_levels;
  if (comm.size() > 1 && before_last > 0 && !are_leaves_even(comm, sizes)) {
    forest.refine(must_split, before_last);
    forest.partition([&](const Quadrant& q) { return q.level == before_last ? weight_unfinished : 1; });
    refined = before_last;
  }
  WeighedLeaves weighed(sizes, expected.all() / comm.size());
  const auto split_and_weigh = [&](const Quadrant& q) {
    const bool is_split = must_split(q);
    if (comm.size() > 1) weighed.note(q, is_split);
    return is_split;
  };
  forest.refine(split_and_weigh, finest);
  splits.split_outside(comm, forest);
  if (comm.size() > 1 && !weighed.are_shared_evenly(comm)) share_out_leaves(sizes, forest);
  while (true) {
    LeafGraph graph(comm, sizes.grid(), forest);
    const SqueezedLeaves squeezed(graph);
    if (!comm.any(squeezed.any())) return graph;
    forest.split_marked(squeezed.marked());
  }
}

}  // namespace quadloop
