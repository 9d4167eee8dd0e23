#include "mesher/forest/ghost_layer.hpp"

#include <algorithm>

#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

namespace {

/// A range of the curve within one tree: the unit squares of one quadrant.
struct Stretch {
  CurveKey first, last;
};

/// Finds the leaves of this rank that others need, from the partition of the curve.
class GhostFinder {
 public:
  GhostFinder(int rank, const TreeGrid& grid, const CurveOwners& owners)
      : rank_{rank}, trees_x_{grid.trees_x()}, trees_y_{grid.trees_y()}, owners_{owners} {}

  /// Visits the leaves of this rank below a quadrant, where a neighbour may be on another rank.
  void search(const Quadrant& quadrant, std::span<const Quadrant> leaves, std::int32_t first) {
    if (leaves.empty() || surrounded(quadrant)) return;
    if (leaves.front() == quadrant) {
      share(quadrant, first);
      return;
    }
    for (const Corner quarter : corners_along_curve) {
      const Quadrant child = quadrant.child(quarter);
      const auto end = std::partition_point(leaves.begin(), leaves.end(), [&](const Quadrant& q) {
        return curve_index(quarter_at(q.x, q.y, quadrant.level)) <= curve_index(quarter);
      });
      const std::size_t count = end - leaves.begin();
      search(child, leaves.first(count), first);
      leaves = leaves.subspan(count);
      first += static_cast<std::int32_t>(count);
    }
  }

  const Outbox<Ghost>& shared() const { return shared_; }

 private:
  bool in_root(const Quadrant& q) const {
    return q.x >= 0 && q.y >= 0 && (q.x >> Quadrant::unit_level) < trees_x_ &&
           (q.y >> Quadrant::unit_level) < trees_y_;
  }

  Stretch stretch_of(const Quadrant& q) const {
    const auto squares = std::uint64_t{1} << (2 * (Quadrant::unit_level - q.level));
    const CurveKey first = owners_.key_at(q.x, q.y);
    return {first, {first.tree, first.square + squares - 1}};
  }

  bool is_own(const Stretch& s) const {
    const std::size_t rank = rank_;
    return owners_.owns(rank, s.first) && owners_.owns(rank, s.last);
  }

  template <class Visit>
  void for_neighbours(const Quadrant& q, const Visit& visit) const {
    const std::int64_t s = q.size();
    for (std::int64_t dy = -s; dy <= s; dy += s) {
      for (std::int64_t dx = -s; dx <= s; dx += s) {
        const Quadrant neighbour{q.x + dx, q.y + dy, q.level};
        if (in_root(neighbour)) visit(neighbour);
      }
    }
  }

  /// Whether the quadrant and all of its size around it belong to this rank.
  bool surrounded(const Quadrant& quadrant) const {
    bool all_own = true;
    for_neighbours(quadrant, [&](const Quadrant& q) { all_own = all_own && is_own(stretch_of(q)); });
    return all_own;
  }

  void share(const Quadrant& leaf, std::int32_t index) {
    touched_.clear();
    for_neighbours(leaf, [&](const Quadrant& q) { collect_owners(leaf, q); });
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const int rank : touched_) {
      if (rank != rank_) shared_.add(rank, {leaf, rank_, index});
    }
  }

  /// Collects the ranks that own a part of `q` which touches the leaf.
  void collect_owners(const Quadrant& leaf, const Quadrant& q) {
    const Stretch stretch = stretch_of(q);
    const int owner = owners_.rank_of(stretch.first);
    if (owner == owners_.rank_of(stretch.last)) {
      touched_.push_back(owner);
      return;
    }
    for (const Corner quarter : corners_along_curve) {
      if (chebyshev_gap(leaf, q.child(quarter)) == 0) collect_owners(leaf, q.child(quarter));
    }
  }

  int rank_, trees_x_, trees_y_;
  const CurveOwners& owners_;
  std::vector<int> touched_;
  Outbox<Ghost> shared_;
};

}  // namespace

std::vector<Ghost> ghost_layer(const Communicator& comm, const TreeGrid& grid, const CurveOwners& owners,
                               std::span<const Quadrant> leaves) {
  if (comm.size() == 1) return {};
  GhostFinder finder(comm.rank(), grid, owners);
  const auto tree_of = [](const Quadrant& q) {
    return Quadrant{q.x >> Quadrant::unit_level, q.y >> Quadrant::unit_level, 0};
  };
  for (std::size_t begin = 0, end = 0; begin < leaves.size(); begin = end) {
    const Quadrant tree = tree_of(leaves[begin]);
    const auto rest = leaves.subspan(begin);
    end = begin + static_cast<std::size_t>(
                      std::partition_point(rest.begin(), rest.end(),
                                           [&](const Quadrant& q) { return tree_of(q) == tree; }) -
                      rest.begin());
    const Quadrant root{tree.x << Quadrant::unit_level, tree.y << Quadrant::unit_level, 0};
    finder.search(root, leaves.subspan(begin, end - begin), static_cast<std::int32_t>(begin));
  }
  return finder.shared().deliver(comm);
}

}  // namespace quadloop
