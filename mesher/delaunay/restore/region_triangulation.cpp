#include "mesher/delaunay/restore/region_triangulation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace quadloop {

namespace {

/// The node of the smallest number over all ranks.
void put_smallest_first(const StarHalo& halo, std::array<std::int32_t, 3>& nodes) {
  const auto goes_first = [&](std::int32_t a, std::int32_t b) { return halo.global(a) < halo.global(b); };
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end(), goes_first), nodes.end());
}

/// Its nodes come in an order that all ranks have, and so does the sum.
Point centroid(const StarHalo& halo, const std::array<std::int32_t, 3>& nodes) {
  const auto at = [&](std::size_t k) { return halo.points()[nodes[k]]; };
  return 1.0 / 3 * (at(0) + at(1) + at(2));
}

/// A triangle that is gone.
struct Gone {
  std::array<std::int32_t, 3> nodes;
  FreedTriangle triangle;
  Point centroid;
};

template <class Triangle>
std::pair<Triangle, std::int32_t> nodes_and_block(const std::pair<Triangle, FreedTriangle>& before) {
  return {before.first, before.second.block};
}
template <class Triangle>
const std::pair<Triangle, std::int32_t>& nodes_and_block(const std::pair<Triangle, std::int32_t>& after) {
  return after;
}

/// The triangles that are gone around each node.
class GoneTriangles {
 public:
  GoneTriangles(std::size_t nodes, std::span<const Gone> gone)
      : gone_{gone}, starts_(nodes + 2, 0), around_(3 * gone.size()) {
    for (const Gone& g : gone) {
      for (const std::int32_t node : g.nodes) ++starts_[node + std::size_t{2}];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    for (std::int32_t i = 0; i < std::ssize(gone); ++i) {
      for (const std::int32_t node : gone[i].nodes) around_[starts_[node + std::size_t{1}]++] = i;
    }
  }

  /// The number of the one of a block around the node that is nearest to a point; of several as near the
  /// lowest.
  std::int64_t nearest(std::size_t node, Point p, std::int32_t block) const {
    std::pair best{std::numeric_limits<double>::infinity(), std::numeric_limits<std::int64_t>::max()};
    for (std::int32_t at = starts_[node]; at < starts_[node + 1]; ++at) {
      const auto& [nodes, triangle, centroid] = gone_[around_[at]];
      const Point off = centroid - p;
      if (triangle.block == block) best = std::min(best, {dot(off, off), triangle.number});
    }
    return best.second;
  }

 private:
  std::span<const Gone> gone_;
  std::vector<std::int32_t> starts_;  ///< of each node, in around_
  std::vector<std::int32_t> around_;  ///< indices of those that are gone
};

}  // namespace

RegionTriangulation::RegionTriangulation(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of) {
  const Changes changes = flip(halo, rank_of);
  if (!uncertain_) compare(halo, changes);
}

/// The patch, which is large, is gone before the changes are looked at.
RegionTriangulation::Changes RegionTriangulation::flip(const StarHalo& halo,
                                                       const std::function<TieRank(Point)>& rank_of) {
  std::vector<char> open;
  for (std::size_t i = 0; i < halo.triangles().size() && !halo.complete(); ++i)
    open.push_back(halo.at_rim(i) ? 1 : 0);
  const auto rank_of_node = [&](std::int32_t node) { return rank_of(halo.points()[node]); };
  const DelaunayPatch patch(halo.points(), rank_of_node, halo.triangles(), open, halo.blocks(), halo.moved());
  uncertain_ = !halo.complete() && is_uncertain(halo, patch);
  return uncertain_ ? Changes{} : find_changes(halo, patch);
}

bool RegionTriangulation::is_uncertain(const StarHalo& halo, const DelaunayPatch& patch) {
  const std::vector<char> doubts = patch.doubtful();
  for (std::size_t t = 0; t < doubts.size(); ++t) {
    const Triangle& nodes = patch.triangles()[t];
    const auto is_own = [&](std::int32_t node) { return halo.owns(node); };
    if (doubts[t] != 0 && std::any_of(nodes.begin(), nodes.end(), is_own)) return true;
  }
  return false;
}

/// Finds those that have outgrown the region, too: with an edge of one triangle between nodes that may have
/// more triangles around them than the region has.
RegionTriangulation::Changes RegionTriangulation::find_changes(const StarHalo& halo,
                                                               const DelaunayPatch& patch) {
  Changes changes;
  const auto &was = halo.triangles(), &now = patch.triangles();
  for (std::size_t i = 0; i < was.size(); ++i) {
    if (was[i] == now[i]) continue;
    Triangle before = was[i], after = now[i];
    put_smallest_first(halo, before);
    put_smallest_first(halo, after);
    const std::int32_t block = halo.blocks().empty() ? 0 : halo.blocks()[i];
    changes.before.push_back({before, {halo.number(i), block}});
    changes.after.emplace_back(after, block);
    if (!halo.owns(after[0]) ||
        !patch.has_single_edge(i, [&](std::int32_t node) { return !halo.is_core(node); }))
      continue;
    for (const std::int32_t node : after) outgrown_.push_back(halo.global(node));
  }
  std::sort(changes.before.begin(), changes.before.end());
  std::sort(changes.after.begin(), changes.after.end());
  return changes;
}

/// A triangle may come back in another slot of the patch.
void RegionTriangulation::compare(const StarHalo& halo, const Changes& changes) {
  const auto& [before, after] = changes;
  const auto goes_first = [](const auto& a, const auto& b) {
    return nodes_and_block(a) < nodes_and_block(b);
  };
  std::vector<std::pair<Triangle, FreedTriangle>> lost;
  std::vector<std::pair<Triangle, std::int32_t>> made;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(lost),
                      goes_first);
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(made),
                      goes_first);
  std::vector<Gone> gone;
  gone.reserve(lost.size());
  freed_.reserve(lost.size());
  for (const auto& [nodes, freed] : lost) {
    gone.push_back({nodes, freed, centroid(halo, nodes)});
    if (halo.owns(nodes[0])) freed_.push_back(freed);
  }
  const GoneTriangles gone_triangles(halo.points().size(), gone);
  made_.reserve(made.size());
  for (const auto& [t, block] : made) {
    if (!halo.owns(t[0])) continue;
    MadeTriangle triangle{gone_triangles.nearest(t[0], centroid(halo, t), block), {}, {}, block};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.nodes[k] = halo.global(t[k]);
      triangle.points[k] = halo.points()[t[k]];
    }
    made_.push_back(triangle);
  }
}

}  // namespace quadloop
