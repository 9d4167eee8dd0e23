#include "mesher/forest/ghost_layer.hpp"

#include <algorithm>

namespace quadloop {

namespace {

/// Spreads the low 32 bits, so that a zero stands between any two of them.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
  bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
  bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// A stretch of the curve within one tree: the unit squares of one quadrant.
struct Stretch {
  CurvePlace first, last;
};

/// Who owns which part of the curve, and which of this rank's leaves others must know.
class GhostFinder {
 public:
  GhostFinder(int rank, const Lattice& lattice, const Forest& forest)
      : rank_{rank},
        trees_x_{lattice.trees_x()},
        trees_y_{lattice.trees_y()},
        forest_{forest},
        begins_{forest.begins()} {}

  /// Visits the leaves below `place`, which are this rank's, as far as a neighbour may be another rank's.
  void search(const Quadrant& place, std::span<const Quadrant> leaves, std::int32_t first) {
    if (leaves.empty() || surrounded(place)) return;
    if (leaves.front() == place) {
      share(place, first);
      return;
    }
    for (const Corner quarter : corners_along_curve) {
      const Quadrant child = place.child(quarter);
      const auto end = std::partition_point(leaves.begin(), leaves.end(), [&](const Quadrant& q) {
        return curve_index(quarter_at(q.x, q.y, place.level)) <= curve_index(quarter);
      });
      const auto count = static_cast<std::size_t>(end - leaves.begin());
      search(child, leaves.first(count), first);
      leaves = leaves.subspan(count);
      first += static_cast<std::int32_t>(count);
    }
  }

  std::vector<std::vector<Ghost>> take_shared() { return std::move(shared_); }

 private:
  bool in_root(const Quadrant& q) const {
    return q.x >= 0 && q.y >= 0 && (q.x >> Quadrant::unit_level) < trees_x_ &&
           (q.y >> Quadrant::unit_level) < trees_y_;
  }

  Stretch stretch_of(const Quadrant& q) const {
    constexpr std::int64_t within = (std::int64_t{1} << Quadrant::unit_level) - 1;
    const auto squares = std::uint64_t{1} << (2 * (Quadrant::unit_level - q.level));
    const std::uint64_t first = spread(static_cast<std::uint64_t>(q.x & within)) |
                                spread(static_cast<std::uint64_t>(q.y & within)) << 1;
    const std::int32_t tree = forest_.tree_at(q);
    return {{tree, first}, {tree, first + squares - 1}};
  }

  int owner_of(const CurvePlace& place) const {
    return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), place) - begins_.begin()) - 1;
  }

  bool is_own(const Stretch& s) const {
    const auto rank = static_cast<std::size_t>(rank_);
    return begins_[rank] <= s.first && s.last < begins_[rank + 1];
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

  /// Whether the quadrant and all of its size around it are this rank's.
  bool surrounded(const Quadrant& place) const {
    bool all_own = true;
    for_neighbours(place, [&](const Quadrant& q) { all_own = all_own && is_own(stretch_of(q)); });
    return all_own;
  }

  void share(const Quadrant& leaf, std::int32_t index) {
    touched_.clear();
    for_neighbours(leaf, [&](const Quadrant& q) { collect_owners(leaf, q); });
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const int rank : touched_) {
      if (rank != rank_) shared_[static_cast<std::size_t>(rank)].push_back({leaf, rank_, index});
    }
  }

  /// The ranks that own a part of `q` which touches the leaf.
  void collect_owners(const Quadrant& leaf, const Quadrant& q) {
    const Stretch stretch = stretch_of(q);
    const int owner = owner_of(stretch.first);
    if (owner == owner_of(stretch.last)) {
      touched_.push_back(owner);
      return;
    }
    for (const Corner quarter : corners_along_curve) {
      if (chebyshev_gap(leaf, q.child(quarter)) == 0) collect_owners(leaf, q.child(quarter));
    }
  }

  int rank_, trees_x_, trees_y_;
  const Forest& forest_;
  std::vector<CurvePlace> begins_;  ///< of each rank's part, and the end of the curve
  std::vector<int> touched_;
  std::vector<std::vector<Ghost>> shared_ = std::vector<std::vector<Ghost>>(begins_.size() - 1);
};

}  // namespace

std::vector<Ghost> ghost_layer(const Communicator& comm, const Lattice& lattice, const Forest& forest,
                               std::span<const Quadrant> leaves) {
  std::vector<Ghost> ghosts;
  if (comm.size() == 1) return ghosts;
  GhostFinder finder(comm.rank(), lattice, forest);
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
  for (const auto& from_rank : comm.exchange(finder.take_shared()))
    ghosts.insert(ghosts.end(), from_rank.begin(), from_rank.end());
  return ghosts;
}

}  // namespace quadloop
