#include "mesher/delaunay/restore/region_triangulation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace quadloop {

namespace {

/// Rotates a triangle so that the node with the smallest global number is first.
void put_smallest_first(const StarHalo& halo, std::array<std::int32_t, 3>& nodes) {
  const auto goes_first = [&](std::int32_t a, std::int32_t b) { return halo.global(a) < halo.global(b); };
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end(), goes_first), nodes.end());
}

/// All ranks see the nodes in the same order, so the sum has the same bits.
Point centroid(const StarHalo& halo, const std::array<std::int32_t, 3>& nodes) {
  const auto at = [&](std::size_t k) { return halo.points()[nodes[k]]; };
  return 1.0 / 3 * (at(0) + at(1) + at(2));
}

/// The previous triangles of the changed slots, by node.
class TrianglesBefore {
 public:
  TrianglesBefore(const StarHalo& halo, std::span<const RegionTriangulation::Before> triangles)
      : triangles_{triangles}, starts_(halo.points().size() + 2, 0), around_(3 * triangles.size()) {
    for (const auto& before : triangles) {
      for (const std::int32_t node : before.nodes) ++starts_[node + std::size_t{2}];
      centroids_.push_back(centroid(halo, before.nodes));
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    for (std::int32_t i = 0; i < std::ssize(triangles); ++i) {
      for (const std::int32_t node : triangles[i].nodes) around_[starts_[node + std::size_t{1}]++] = i;
    }
    stays_.resize(triangles.size(), 0);
  }

  bool stays(std::size_t i) const { return stays_[i] != 0; }

  /// Whether a triangle existed before, in any slot; if so, it does not count as removed.
  bool find_again(const RegionTriangulation::After& after) {
    for (const std::int32_t i : around(after.nodes[0])) {
      if (triangles_[i].nodes != after.nodes || triangles_[i].freed.block != after.block) continue;
      stays_[i] = 1;
      return true;
    }
    return false;
  }

  /// The number of the removed triangle of a block around the node that is nearest to a point; the lowest of
  /// equally near ones.
  std::int64_t nearest_gone(std::int32_t node, Point p, std::int32_t block) const {
    std::pair best{std::numeric_limits<double>::infinity(), std::numeric_limits<std::int64_t>::max()};
    for (const std::int32_t i : around(node)) {
      if (stays(i) || triangles_[i].freed.block != block) continue;
      const Point off = centroids_[i] - p;
      best = std::min(best, {dot(off, off), triangles_[i].freed.number});
    }
    return best.second;
  }

 private:
  std::span<const std::int32_t> around(std::int32_t node) const {
    const std::int32_t begin = starts_[node], end = starts_[node + std::size_t{1}];
    return std::span(around_).subspan(begin, end - begin);
  }

  std::span<const RegionTriangulation::Before> triangles_;
  std::vector<std::int32_t> starts_;  ///< start in around_ for each node
  std::vector<std::int32_t> around_;  ///< indices of triangles
  std::vector<Point> centroids_;
  std::vector<char> stays_;  ///< flags the triangles that exist again
};

}  // namespace

RegionTriangulation::RegionTriangulation(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of) {
  Changes changes = flip(halo, rank_of);
  if (!uncertain_) compare(halo, std::move(changes));
}

/// Frees the patch, which is large, before the changes are compared.
RegionTriangulation::Changes RegionTriangulation::flip(const StarHalo& halo,
                                                       const std::function<TieRank(Point)>& rank_of) {
  std::vector<char> open;
  for (std::size_t i = 0; i < halo.triangles().size() && !halo.complete(); ++i)
    open.push_back(halo.at_rim(i) ? 1 : 0);
  const auto rank_of_node = [&](std::int32_t node) { return rank_of(halo.points()[node]); };
  const DelaunayPatch patch(halo.points(), rank_of_node, halo.triangles(), open, halo.blocks(), halo.moved(),
                            halo.kept_edges());
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

/// Also finds nodes whose changes reach the border of the region: ends of an edge with one triangle, both of
/// which may have more triangles than the region contains.
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
    changes.after.push_back({after, block});
    if (!halo.owns(after[0]) ||
        !patch.has_single_edge(i, [&](std::int32_t node) { return !halo.is_core(node); }))
      continue;
    for (const std::int32_t node : after) outgrown_.push_back(halo.global(node));
  }
  return changes;
}

/// A triangle may reappear in another slot of the patch.
void RegionTriangulation::compare(const StarHalo& halo, Changes changes) {
  TrianglesBefore before(halo, changes.before);
  std::erase_if(changes.after, [&](const After& after) { return before.find_again(after); });
  for (std::size_t i = 0; i < changes.before.size(); ++i) {
    if (!before.stays(i) && halo.owns(changes.before[i].nodes[0])) freed_.push_back(changes.before[i].freed);
  }
  made_.reserve(changes.after.size());
  for (const auto& [nodes, block] : changes.after) {
    if (!halo.owns(nodes[0])) continue;
    MadeTriangle made{before.nearest_gone(nodes[0], centroid(halo, nodes), block), {}, {}, block};
    for (std::size_t k = 0; k < 3; ++k) {
      made.nodes[k] = halo.global(nodes[k]);
      made.points[k] = halo.points()[nodes[k]];
    }
    made_.push_back(made);
  }
}

}  // namespace quadloop
