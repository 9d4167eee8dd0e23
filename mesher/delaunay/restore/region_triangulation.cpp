#include "mesher/delaunay/restore/region_triangulation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace quadloop {

namespace {

template <class Node>
void put_smallest_first(std::array<Node, 3>& nodes) {
  std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
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
    for (std::size_t at = starts_[node]; at < starts_[node + 1]; ++at) {
      const auto& [nodes, triangle, centroid] = gone_[around_[at]];
      const Point off = centroid - p;
      if (triangle.block == block) best = std::min(best, {dot(off, off), triangle.number});
    }
    return best.second;
  }

 private:
  std::span<const Gone> gone_;
  std::vector<std::size_t> starts_;   ///< of each node, in around_
  std::vector<std::int32_t> around_;  ///< indices of those that are gone
};

/// The nodes of the triangles at hand in the order of their numbers. Most are the rank's own, which need no
/// sorting.
class NodeRow {
 public:
  explicit NodeRow(const StarHalo& halo) : halo_{halo} {
    std::vector<GlobalNodeId> owned;  // of each owned node; -1 for those that are not met
    for (const NumberedTriangle& t : halo.triangles()) {
      for (const GlobalNodeId node : t.nodes) note(node, owned);
    }
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    std::erase_if(owned, [](GlobalNodeId node) { return node.value() < 0; });
    lower_ = owned.empty() ? 0 : std::lower_bound(others_.begin(), others_.end(), owned[0]) - others_.begin();
    numbers_.assign(others_.begin(), others_.begin() + lower_);
    for (const GlobalNodeId node : owned) {
      place_[halo.local(node).value()] = size32(numbers_);
      numbers_.push_back(node);
    }
    owned_ = std::ssize(owned);
    numbers_.insert(numbers_.end(), others_.begin() + lower_, others_.end());
  }

  std::int32_t place_of(GlobalNodeId node) const {
    if (halo_.owns(node)) return place_[halo_.local(node).value()];
    const auto at = std::lower_bound(others_.begin(), others_.end(), node) - others_.begin();
    return static_cast<std::int32_t>(at < lower_ ? at : at + owned_);
  }
  const std::vector<GlobalNodeId>& numbers() const { return numbers_; }

 private:
  void note(GlobalNodeId node, std::vector<GlobalNodeId>& owned) {
    if (!halo_.owns(node)) return others_.push_back(node);
    const auto at = static_cast<std::size_t>(halo_.local(node).value());
    if (at >= owned.size()) owned.resize(at + 1, GlobalNodeId{-1});
    if (at >= place_.size()) place_.resize(at + 1, -1);
    owned[at] = node;
  }

  const StarHalo& halo_;
  std::vector<GlobalNodeId> numbers_, others_;  ///< of all; of other ranks' nodes
  std::vector<std::int32_t> place_;             ///< of owned nodes
  std::ptrdiff_t lower_ = 0, owned_ = 0;        ///< how many of the others come before, and of those between
};

}  // namespace

RegionTriangulation::RegionTriangulation(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of) {
  gather_nodes(halo);
  const Changes changes = flip(halo, rank_of);
  if (uncertain_) return;
  compare(halo, changes);
  find_outgrown();
}

/// The patch, which is large, is gone before the changes are looked at.
RegionTriangulation::Changes RegionTriangulation::flip(const StarHalo& halo,
                                                       const std::function<TieRank(Point)>& rank_of) {
  const DelaunayPatch patch = make_patch(halo, rank_of);
  const std::vector<char> doubts = patch.doubtful();
  for (std::size_t t = 0; t < doubts.size() && !uncertain_; ++t) {
    const Triangle& nodes = patch.triangles()[t];
    uncertain_ = doubts[t] != 0 && std::any_of(nodes.begin(), nodes.end(),
                                               [&](std::int32_t node) { return halo.owns(number_of(node)); });
  }
  return uncertain_ ? Changes{} : find_changes(halo, patch);
}

void RegionTriangulation::gather_nodes(const StarHalo& halo) {
  const NodeRow row(halo);
  numbers_ = row.numbers();
  points_.resize(numbers_.size());
  core_.resize(numbers_.size());
  moved_.resize(numbers_.size());
  triangles_.reserve(halo.triangles().size());
  blocks_.reserve(halo.triangles().size());
  for (const NumberedTriangle& t : halo.triangles()) {
    Triangle& nodes = triangles_.emplace_back();
    blocks_.push_back(t.block);
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k] = row.place_of(t.nodes[k]);
      points_[nodes[k]] = t.points[k];
      core_[nodes[k]] = t.core[k];
      moved_[nodes[k]] = t.moved[k];
    }
  }
}

DelaunayPatch RegionTriangulation::make_patch(const StarHalo& halo,
                                              const std::function<TieRank(Point)>& rank_of) const {
  std::vector<TieRank> ranks;
  ranks.reserve(points_.size());
  for (const Point& p : points_) ranks.push_back(rank_of(p));
  std::vector<char> open;
  for (const NumberedTriangle& t : halo.triangles()) open.push_back(halo.at_rim(t) ? 1 : 0);
  return {points_, ranks, triangles_, open, blocks_, moved_};
}

RegionTriangulation::Changes RegionTriangulation::find_changes(const StarHalo& halo,
                                                               const DelaunayPatch& patch) const {
  Changes changes;
  const auto& now = patch.triangles();
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) count += triangles_[i] == now[i] ? 0 : 1;
  changes.before.reserve(count);
  changes.after.reserve(count);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    Triangle before = triangles_[i], after = now[i];
    if (before == after) continue;
    put_smallest_first(before);
    put_smallest_first(after);
    changes.before.push_back({before, {halo.triangles()[i].number, blocks_[i]}});
    changes.after.emplace_back(after, blocks_[i]);
  }
  std::sort(changes.before.begin(), changes.before.end());
  std::sort(changes.after.begin(), changes.after.end());
  return changes;
}

/// Its nodes come in an order that all ranks have, and so does the sum.
Point RegionTriangulation::centroid(const Triangle& nodes) const {
  const auto at = [&](std::size_t k) { return points_[nodes[k]]; };
  return 1.0 / 3 * (at(0) + at(1) + at(2));
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
    gone.push_back({nodes, freed, centroid(nodes)});
    if (halo.owns(number_of(nodes[0]))) freed_.push_back(freed);
  }
  const GoneTriangles gone_triangles(points_.size(), gone);
  made_.reserve(made.size());
  new_triangles_.reserve(made.size());
  for (const auto& [t, block] : made) {
    if (!halo.owns(number_of(t[0]))) continue;
    MadeTriangle triangle{gone_triangles.nearest(t[0], centroid(t), block), {}, {}, block};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.nodes[k] = number_of(t[k]);
      triangle.points[k] = points_[t[k]];
    }
    new_triangles_.push_back(t);
    made_.push_back(triangle);
  }
}

/// Those with one triangle at hand, between nodes that may have more triangles around them than the region
/// has; of all, those that a new triangle may have.
std::vector<RegionTriangulation::Edge> RegionTriangulation::outer_edges() const {
  std::vector<char> asked(points_.size(), 0);  // for edges of new triangles
  for (const Triangle& nodes : new_triangles_) {
    for (const std::int32_t node : nodes) asked[node] = is_core(node) ? 0 : 1;
  }
  std::vector<Edge> edges, single;
  for (const Triangle& nodes : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({nodes[k], nodes[(k + 1) % 3]});
      if (asked[low] != 0 && asked[high] != 0) edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if (next - edge == 1) single.push_back(*edge);
    edge = next;
  }
  return single;
}

void RegionTriangulation::find_outgrown() {
  const std::vector<Edge> outer = outer_edges();
  for (std::size_t i = 0; i < new_triangles_.size(); ++i) {
    const Triangle& t = new_triangles_[i];
    const auto is_outer = [&](std::size_t k) {
      const auto [low, high] = std::minmax({t[k], t[(k + 1) % 3]});
      return std::binary_search(outer.begin(), outer.end(), Edge{low, high});
    };
    if (is_outer(0) || is_outer(1) || is_outer(2))
      outgrown_.insert(outgrown_.end(), made_[i].nodes.begin(), made_[i].nodes.end());
  }
}

}  // namespace quadloop
