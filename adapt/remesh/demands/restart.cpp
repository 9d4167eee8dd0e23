#include "adapt/remesh/demands/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "adapt/sensor/cells_of_leaves.hpp"
#include "generate/leaf_quadrant.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

constexpr std::int64_t siblings = 4;

int child_number(const Quadrant& q) { return curve_index(quarter_at(q.x, q.y, q.level - 1)); }

/// Whether a cell may be coarsened. An empty cell has no flag of its own: its siblings decide.
bool may_go(const LeafRecord& leaf, RefinementFlag mark) {
  return mark == RefinementFlag::coarsen || (mark == RefinementFlag::keep && !has_cells(leaf));
}

/// A quadtree cell, and whether it is to be coarsened.
struct MarkedLeaf {
  Quadrant leaf;
  bool goes = false;
};

/// This rank's quadtree cells with as many neighbours before and after them on the curve as a family of
/// siblings can extend.
class LeafRun {
 public:
  /// Tree and flags must outlive the object. *Collective.*
  LeafRun(const Communicator& comm, const TreeRecord& tree, std::span<const RefinementFlag> flags)
      : leaves_{tree.leaves}, flags_{flags}, first_{comm.exclusive_sum(std::ssize(tree.leaves))} {
    const auto count = std::ssize(leaves_);
    std::vector<Numbered> ends;
    for (std::int64_t i = 0; i < count; ++i) {
      if (i == siblings - 1) i = std::max(i, count - (siblings - 1));
      if (i < count) ends.push_back({first_ + i, own(i)});
    }
    for (const Numbered& end : comm.all_gather_values(std::span<const Numbered>(ends))) {
      if (end.number < first_ && end.number >= first_ - (siblings - 1)) before_.push_back(end.leaf);
      if (end.number >= first_ + count && end.number < first_ + count + (siblings - 1))
        after_.push_back(end.leaf);
    }
  }

  /// Whether all four siblings of the cell with this number are to be coarsened.
  bool family_goes(std::int64_t index) const {
    const Quadrant q = own(index).leaf;
    const std::int64_t eldest = index - child_number(q);
    if (eldest < -std::ssize(before_) || eldest + siblings > std::ssize(leaves_) + std::ssize(after_))
      return false;
    for (std::int64_t k = 0; k < siblings; ++k) {
      const MarkedLeaf sibling = at(eldest + k);
      if (sibling.leaf.level != q.level || child_number(sibling.leaf) != k || !sibling.goes) return false;
    }
    return true;
  }

 private:
  struct Numbered {
    std::int64_t number;
    MarkedLeaf leaf;
  };

  MarkedLeaf own(std::int64_t index) const {
    return {quadrant_of(leaves_[index]), may_go(leaves_[index], flags_[index])};
  }
  MarkedLeaf at(std::int64_t index) const {
    if (index < 0) return before_[std::ssize(before_) + index];
    return index < std::ssize(leaves_) ? own(index) : after_[index - std::ssize(leaves_)];
  }

  std::span<const LeafRecord> leaves_;
  std::span<const RefinementFlag> flags_;
  std::int64_t first_;  ///< global number of this rank's first cell
  std::vector<MarkedLeaf> before_, after_;
};

}  // namespace

std::vector<SplitDemand> adapted_splits(const TreeRecord& tree) {
  std::vector<SplitDemand> demands;
  for (const LeafRecord& leaf : tree.leaves) {
    if (leaf.adapted != 0) demands.push_back({quadrant_of(leaf), leaf.adapted});
  }
  return demands;
}

std::vector<SplitDemand> wanted_splits(const TreeRecord& tree) {
  std::vector<SplitDemand> demands;
  for (const LeafRecord& leaf : tree.leaves) {
    const std::uint32_t above = leaf.wanted > 0 ? 1U << (leaf.wanted - 1) : 0U;
    if ((leaf.adapted | above) != 0) demands.push_back({quadrant_of(leaf), leaf.adapted | above});
  }
  return demands;
}

std::vector<SplitDemand> unchanged_splits(const TreeRecord& tree, const MeshInput& input) {
  const bool same_geometry = tree.attributes.geometry_digest == input.geometry.digest();
  const bool same_case = tree.attributes.case_digest == input.digest;
  return same_geometry && !same_case ? wanted_splits(tree) : adapted_splits(tree);
}

ChangedSplits changed_splits(const Communicator& comm, const TreeRecord& tree,
                             std::span<const RefinementFlag> flags,
                             std::span<const std::int8_t> finest_levels) {
  QUADLOOP_REQUIRE(flags.size() == tree.leaves.size() && finest_levels.size() == flags.size(),
                   "one mark and one finest level for each leaf");
  std::optional<LeafRun> run;  // only if some cell is to be coarsened
  if (comm.any(std::find(flags.begin(), flags.end(), RefinementFlag::coarsen) != flags.end()))
    run.emplace(comm, tree, flags);
  ChangedSplits changed;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const LeafRecord& leaf = tree.leaves[i];
    std::uint32_t levels = leaf.adapted;
    if (flags[i] == RefinementFlag::refine && leaf.level < finest_levels[i]) {
      levels |= 1U << leaf.level;
      ++changed.refined;
    }
    const std::uint32_t parent = leaf.level > 0 ? 1U << (leaf.level - 1) : 0U;
    if (run && (leaf.adapted & parent) != 0 && may_go(leaf, flags[i]) && run->family_goes(i)) {
      levels &= ~parent;
      ++changed.coarsened;
    }
    if (levels != 0) changed.demands.push_back({quadrant_of(leaf), levels});
  }
  changed.refined = comm.sum(changed.refined);
  changed.coarsened = comm.sum(changed.coarsened);
  return changed;
}

void keep_root(const TreeAttributes& tree, MeshInput& input) {
  const Box root = root_box(tree);
  if (!input.mesh.size.root) {
    const TreeGrid grid = choose_root(input.geometry, input.mesh.size);
    const bool same = grid.box().low == root.low && grid.tree_edge() == tree.tree_edge &&
                      grid.trees_x() == tree.trees_x && grid.trees_y() == tree.trees_y;
    if (same) return;
  }
  const Geometry& geometry = input.geometry;
  const bool is_inside = root.contains(geometry.box().low) && root.contains(geometry.box().high);
  for (std::int32_t v = 0; !is_inside && v < geometry.size(); ++v) {
    const Point p = geometry.point(v);
    if (root.contains(p)) continue;
    throw InputError(
        fmt::format("boundary {}: the point ({}, {}) lies outside the root of the saved tree, from ({}, {}) "
                    "to ({}, {}); mesh without the tree",
                    geometry.boundary(geometry.boundary_of(v)).name, p.x, p.y, root.low.x, root.low.y,
                    root.high.x, root.high.y));
  }
  input.mesh.size.root = RootOptions{root.low, tree.tree_edge, tree.trees_x, tree.trees_y, root.high};
}

}  // namespace quadloop::adapt
