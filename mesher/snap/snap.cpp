#include "mesher/snap/snap.hpp"

#include <algorithm>

#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

namespace {

/// Where a leaf that lies in this direction from the snap has it.
Site site_in(const Quadrant& leaf, Corner direction, const Snap& snap) {
  if (!snap.on_edge) return leaf.site(snap.corner);
  const Halves towards = halves_of(site_of(direction));
  if (snap.vertical) return elsewhere_on(towards.x == 0 ? Side::right : Side::left);
  return elsewhere_on(towards.y == 0 ? Side::top : Side::bottom);
}

}  // namespace

std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps) {
  std::vector<LeafSnap> result;
  LeafFinder finder(graph);
  for (const Snap& snap : snaps) {
    const std::array<LeafId, 4> round = finder.leaves_round(snap.corner);
    const std::size_t first = result.size();
    for (const Corner direction : corners_along_curve) {
      const LeafId leaf = round[index_of(direction)];
      const bool seen = std::any_of(result.begin() + first, result.end(),
                                    [&](const LeafSnap& s) { return s.leaf == leaf; });
      if (graph.is_local(leaf) && !seen)
        result.push_back({leaf, site_in(graph.leaf(leaf), direction, snap), &snap});
    }
  }
  std::sort(result.begin(), result.end(), [](const LeafSnap& a, const LeafSnap& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : a.site < b.site;
  });
  return result;
}

}  // namespace quadloop
