#include "mesher/forest/outside_splits.hpp"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

namespace {

bool is_in_root(const TreeGrid& grid, const Quadrant& q) {
  const std::int64_t width = std::int64_t{grid.trees_x()} << Quadrant::unit_level,
                     height = std::int64_t{grid.trees_y()} << Quadrant::unit_level;
  return q.x >= 0 && q.y >= 0 && q.x < width && q.y < height;
}

Quadrant parent_of(const Quadrant& q) {
  const std::int64_t mask = ~(2 * q.size() - 1);
  return {q.x & mask, q.y & mask, q.level - 1};
}

/// The corner that a quadrant and its parent share.
Corner corner_of_parent(const Quadrant& q) { return quarter_at(q.x, q.y, q.level - 1); }

/// A quadrant to be split, with its place on the curve.
struct Placed {
  CurveKey key;
  Quadrant quadrant;
  friend bool operator<(const Placed& a, const Placed& b) {
    return std::tie(a.key, a.quadrant.level) < std::tie(b.key, b.quadrant.level);
  }
  friend bool operator==(const Placed& a, const Placed& b) { return a.quadrant == b.quadrant; }
};

void keep_one_of_each(std::vector<Placed>& quadrants) {
  std::ranges::sort(quadrants, std::less<>{});
  const auto twice = std::ranges::unique(quadrants);
  quadrants.erase(twice.begin(), twice.end());
}

}  // namespace

bool OutsideSplits::is_split_by_size(const Quadrant& q) {
  if (cursor_.segments_in(q).empty()) return cursor_.is_inside(q, Corner::south_west);
  if (!cursor_.is_inside(q, corner_of_parent(q))) cut_[q.level].push_back(q);
  return true;
}

/// Adds the quadrants that must be split because q is. A leaf that touches a child of q is at most as large
/// as q, so all quadrants of q's size around q must exist, and their parents must be split. These are four:
/// q's own parent and those that meet it in the corner shared with q. As no boundary passes through a grid
/// vertex, those not intersected by the boundary are on the same side as the corner, here outside.
void OutsideSplits::add_parents_round(const Quadrant& q, std::vector<Quadrant>& above) {
  const Quadrant parent = parent_of(q);
  const Halves corner = halves_of(site_of(corner_of_parent(q)));
  const std::int64_t to_x = (corner.x - 1) * parent.size(), to_y = (corner.y - 1) * parent.size();
  for (const std::int64_t y : {parent.y, parent.y + to_y}) {
    for (const std::int64_t x : {parent.x, parent.x + to_x}) {
      const Quadrant round{x, y, parent.level};
      if (is_in_root(sizes_.grid(), round) && is_new(round) && cursor_.segments_in(round).empty())
        above.push_back(round);
    }
  }
}

/// False if it was visited recently; most are visited several times.
bool OutsideSplits::is_new(const Quadrant& q) {
  const int shift = Quadrant::unit_level - q.level;
  const std::int64_t column = q.x >> shift, row = q.y >> shift;
  Quadrant& place = lately_[row % window * window + column % window];
  return std::exchange(place, q) != q;
}

void OutsideSplits::split(const Communicator& comm, Forest& forest) {
  const CurveOwners owners = forest.owners();
  Outbox<Placed> to_owners;
  std::vector<Quadrant> above;
  std::vector<Placed> split;  // outside, of one level
  for (int level = Quadrant::unit_level; level > 1; --level) {
    above.clear();
    for (const Quadrant& q : cut_[level]) add_parents_round(q, above);
    for (const Placed& q : split) add_parents_round(q.quadrant, above);
    split.clear();
    for (const Quadrant& q : above) split.push_back({owners.key_at(q.x, q.y), q});
    keep_one_of_each(split);
    for (const Placed& q : split) to_owners.add(owners.rank_of(q.key), q);
  }
  std::vector<Placed> wanted = to_owners.deliver(comm);
  keep_one_of_each(wanted);
  auto next = wanted.cbegin();
  forest.refine(
      [&](const Quadrant& q) {
        if (next == wanted.cend() || next->quadrant != q) return false;
        ++next;
        return true;
      },
      sizes_.finest_level());
  QUADLOOP_REQUIRE(next == wanted.cend(), "what is to be split outside is a leaf, or becomes one");
}

}  // namespace quadloop
