#include "mesher/forest/refine_forest.hpp"

#include <algorithm>
#include <array>

#include "mesher/base/progress.hpp"
#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

constexpr double quadrants_of_leaf = 4.0 / 3;  ///< leaves and what was split into them
constexpr double parts_to_share = 64;  ///< for each rank, about: quadrants among which the work is shared out

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

/// The work that is yet to be done below a quadrant, in quadrants' shares of what all ranks have to do.
class WorkAhead {
 public:
  WorkAhead(const LeafSample& sample, int ranks)
      : sample_{sample}, share_{units_of(sample.all()) / (parts_to_share * ranks)} {}

  bool is_to_share(const Quadrant& q) const { return units_in(q) > share_; }
  /// Not 0, so that quadrants in which no leaf was looked at are shared out, too.
  int weight(const Quadrant& q) const {
    return 1 +
           static_cast<int>(share_ > 0 ? units_of_share * std::min(units_in(q) / share_, most_shares) : 0);
  }

 private:
  static constexpr double units_of_share = 1000, most_shares = 1e6;
  static double units_of(const LeafSample::Counts& leaves) {
    return weight_uncut * leaves.uncut + weight_cut * leaves.cut;
  }
  double units_in(const Quadrant& q) const { return units_of(sample_.in(q)); }

  const LeafSample& sample_;
  double share_;
};

/// Before the leaves are there: down to quadrants of about as much work each, which are then shared out, so
/// that nothing is looked up in the size tree by two ranks. *Collective.*
void share_out_work(const Communicator& comm, const SizeTree& sizes, const LeafSample& sample,
                    Gradation& gradation, Forest& forest) {
  const WorkAhead ahead(sample, comm.size());
  const auto is_to_split = [&](const Quadrant& q) { return ahead.is_to_share(q) && gradation.must_split(q); };
  forest.refine(is_to_split, sizes.finest_level());
  forest.partition([&](const Quadrant& q) { return ahead.weight(q); });
}

/// By the work of cutting. *Collective.*
void share_out_leaves(const SizeTree& sizes, Forest& forest) {
  SizeCursor cursor(sizes);
  forest.partition(
      [&](const Quadrant& q) { return cursor.segments_in(q).empty() ? weight_uncut : weight_cut; });
}

}  // namespace

LeafGraph refine_forest(const Communicator& comm, const SizeTree& sizes, const LeafEstimate& expected) {
  Gradation gradation(sizes);
  Forest forest(comm, sizes.lattice());
  progress::Stage stage("refinement", expected.all() * quadrants_of_leaf / comm.size(), "quadrants");
  if (comm.size() > 1) share_out_work(comm, sizes, expected.sample, gradation, forest);
  double looked_at = 0;
  const auto must_split = [&](const Quadrant& q) {
    stage.advance(++looked_at);
    return gradation.must_split(q);
  };
  forest.refine(must_split, sizes.finest_level());
  if (comm.size() > 1) share_out_leaves(sizes, forest);
  while (true) {
    LeafGraph graph(comm, sizes.lattice(), forest);
    const SqueezedLeaves squeezed(graph);
    if (!comm.any(squeezed.any())) return graph;
    forest.split_marked(squeezed.marked());
  }
}

}  // namespace quadloop
