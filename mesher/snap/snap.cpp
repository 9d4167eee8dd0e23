#include "mesher/snap/snap.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

namespace {

/// The site of the snap in the leaf that lies in this direction from it. A leaf that lies in two directions
/// has the vertex in the middle of a side.
Site site_in(const Snap& snap, Corner direction) {
  if (snap.in_leaf) return Site::inside;
  const Halves towards = halves_of(site_of(direction));
  if (snap.on_edge && snap.vertical) return elsewhere_on(towards.x == 0 ? Side::right : Side::left);
  if (snap.on_edge) return elsewhere_on(towards.y == 0 ? Side::top : Side::bottom);
  const auto same_leaf = [&](bool east, bool north) {
    return snap.leaves_round[index_of(corner_at(east, north))] == snap.leaves_round[index_of(direction)];
  };
  const bool east = towards.x != 0, north = towards.y != 0;
  return site_at({same_leaf(!east, north) ? 1 : 2 - towards.x, same_leaf(east, !north) ? 1 : 2 - towards.y});
}

/// Counting sort by leaf, then by site within a leaf.
std::vector<LeafSnap> sorted_by_leaf(const LeafGraph& graph, const std::vector<LeafSnap>& snaps) {
  std::vector<std::int32_t> begin_of(graph.local_size() + 1,
                                     0);  // for each leaf the start of its snaps in the sorted array
  for (const LeafSnap& s : snaps) ++begin_of[graph.local_index(s.leaf) + 1];
  std::partial_sum(begin_of.begin(), begin_of.end(), begin_of.begin());
  std::vector<LeafSnap> sorted(snaps.size());
  for (const LeafSnap& s : snaps) sorted[begin_of[graph.local_index(s.leaf)]++] = s;
  for (auto begin = sorted.begin(), end = begin; begin != sorted.end(); begin = end) {
    while (end != sorted.end() && end->leaf == begin->leaf) ++end;
    std::sort(begin, end, [](const LeafSnap& a, const LeafSnap& b) { return a.site < b.site; });
  }
  return sorted;
}

}  // namespace

bool is_between_blocks(const Geometry& geometry, std::int32_t v) {
  const auto between = [&](std::int32_t s) { return geometry.twin(s) >= 0 && !geometry.is_inner_line(s); };
  return geometry.has_twins() && (between(v) || between(geometry.previous(v)));
}

void settle_absorbed(const Geometry& geometry, Snap& snap) {
  for (std::size_t i = 0, count = snap.absorbed.size(); i < count; ++i) {
    const Snap::Absorbed one = snap.absorbed[i];
    const std::int32_t twin = geometry.twin(one.segment);
    if (twin < 0) continue;
    snap.absorbed.push_back({twin, one.vertical});
    if (!geometry.is_tip(twin))
      continue;  // where an inner line ends on a grid line, only one twin crosses it
    const Point tip = geometry.point(twin);
    if (tip.x == snap.centre.x) snap.absorbed.push_back({twin, true});
    if (tip.y == snap.centre.y) snap.absorbed.push_back({twin, false});
  }
  std::sort(snap.absorbed.begin(), snap.absorbed.end());
  snap.absorbed.erase(std::unique(snap.absorbed.begin(), snap.absorbed.end()), snap.absorbed.end());
}

void find_leaves_round(const LeafGraph& graph, std::span<Snap> snaps) {
  LeafFinder finder(graph);
  for (Snap& snap : snaps) snap.leaves_round = finder.leaves_round(snap.corner);
}

std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps) {
  std::vector<LeafSnap> result;
  result.reserve(4 * snaps.size());
  for (const Snap& snap : snaps) {
    const std::size_t first = result.size();
    for (const Corner direction : corners_along_curve) {
      const LeafId leaf = snap.leaves_round[index_of(direction)];
      const bool seen = std::any_of(result.begin() + first, result.end(),
                                    [&](const LeafSnap& s) { return s.leaf == leaf; });
      if (graph.is_local(leaf) && !seen) result.push_back({leaf, site_in(snap, direction), &snap});
    }
  }
  return sorted_by_leaf(graph, result);
}

}  // namespace quadloop
