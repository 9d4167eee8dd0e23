#include "mesher/snap/snap_corners.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "mesher/forest/leaf_finder.hpp"
#include "mesher/snap/leaf_edge.hpp"
#include "mesher/snap/snap_corner.hpp"

namespace quadloop {

namespace {

/// Removes the crossings absorbed by bent edges.
void drop_taken(const std::vector<Snap>& edges, std::vector<Sight>& sights) {
  if (edges.empty()) return;
  std::set<std::tuple<bool, std::int64_t, std::int32_t>> taken;  // vertical, line, segment
  for (const Snap& edge : edges) {
    for (const Snap::Absorbed& a : edge.absorbed)
      taken.emplace(edge.vertical, edge.vertical ? edge.corner.x : edge.corner.y, a.segment);
  }
  std::erase_if(sights, [&](const Sight& s) {
    const bool vertical = is_vertical(s.direction);
    return taken.contains({vertical, vertical ? s.corner.x : s.corner.y, s.segment});
  });
}

/// Whether any crossing may be near enough: up to rounding, the shortest edge at a vertex is at most a
/// sight's edge.
bool may_claim(std::span<const Sight> sights, double share) {
  constexpr double rounding = 1.02;
  return std::any_of(sights.begin(), sights.end(),
                     [&](const Sight& s) { return s.distance < rounding * share * s.edge; });
}

/// Adds hanging snaps at places without a snapped vertex. Both lists are in order; the first `edges` snaps
/// are those of edges, which have no hanging node in the middle.
void add_hanging(std::vector<Snap> hanging, std::size_t edges, std::vector<Snap>& snaps) {
  const std::size_t count = snaps.size();
  std::set<GridPoint> added;
  for (Snap& s : hanging) {
    const auto corners = std::span(snaps).first(count).subspan(edges);
    const bool free = !std::ranges::binary_search(corners, s.corner, comes_earlier, &Snap::corner);
    if (free && added.insert(s.corner).second) snaps.push_back(std::move(s));
  }
}

}  // namespace

std::vector<Snap> choose_snaps(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                               const TracedForest& traced, double share, std::optional<MirrorAxis> mirror) {
  std::vector<Sight> sights = sights_by_corner(graph, grid, geometry, traced);
  Captures captures = capture_points(graph, grid, geometry, traced, share);
  drop_taken(captures.edges, sights);
  std::vector<Snap> snaps = std::move(captures.edges);
  snaps.reserve(snaps.size() + traced.leaves.size());
  find_leaves_round(graph, snaps);
  const std::size_t edges = snaps.size();
  LeafFinder finder(graph);
  auto captured = captures.corners.begin();
  for (std::size_t begin = 0, end = 0; begin < sights.size() || captured != captures.corners.end();
       begin = end) {
    const bool is_captured =
        captured != captures.corners.end() &&
        (begin == sights.size() || !comes_earlier(sights[begin].corner, captured->corner));
    const GridPoint corner = is_captured ? captured->corner : sights[begin].corner;
    while (end < sights.size() && sights[end].corner == corner) ++end;
    const auto seen = std::span<const Sight>(sights).subspan(begin, end - begin);
    if (!is_captured && !may_claim(seen, share)) continue;
    const std::array<LeafId, 4> round = finder.leaves_round(corner);
    const SightedCorner sighted{corner, grid.corner(corner), shortest_edge_of(graph, grid, round), seen,
                                mirror};
    auto snap = is_captured ? snap_captured(geometry, traced.traces, sighted, share, *captured++)
                            : snap_corner(geometry, traced.traces, sighted, share);
    if (!snap) continue;
    snap->leaves_round = round;
    snaps.push_back(std::move(*snap));
  }
  std::vector<Snap> hanging = hanging_snaps(graph, grid, geometry, traced, share);
  find_leaves_round(graph, hanging);
  add_hanging(std::move(hanging), edges, snaps);
  return snaps;
}

}  // namespace quadloop
