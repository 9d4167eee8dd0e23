#include "mesher/snap/corner_sights.hpp"

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "mesher/snap/leaf_edge.hpp"

namespace quadloop {

namespace {

/// Sorts small keys, then moves each sight once. Merge sort, as the vertices are nearly in curve order.
std::vector<Sight> sorted_by_corner(const std::vector<Sight>& sights) {
  struct Key {
    GridPoint corner;
    std::uint32_t index;
  };
  std::vector<Key> keys;
  keys.reserve(sights.size());
  for (const Sight& s : sights) keys.push_back({s.corner, static_cast<std::uint32_t>(keys.size())});
  std::stable_sort(keys.begin(), keys.end(),
                   [](const Key& a, const Key& b) { return comes_earlier(a.corner, b.corner); });
  std::vector<Sight> sorted;
  sorted.reserve(sights.size());
  for (const Key& key : keys) sorted.push_back(sights[key.index]);
  return sorted;
}

}  // namespace

std::vector<Sight> sights_by_corner(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                                    const TracedForest& traced) {
  std::vector<Sight> sights;
  const std::size_t crossings = traced.traces.crossings();
  sights.reserve(crossings + crossings / 8);  // crossings near the middle of an edge are seen from both ends
  for (std::int32_t trace = 0; trace < size32(traced.leaves); ++trace) {
    const LeafId leaf = traced.leaves[trace];
    const LeafTrace view = traced.traces[trace];
    for (std::int32_t p = 0; p < std::ssize(view.pieces); ++p) {
      const Piece& piece = view.pieces[p];
      if (piece.entry < 0) continue;
      for (const std::int32_t c : {piece.entry, piece.exit}) {
        const Crossing& crossing = view.crossing(c);
        if (geometry.is_second(crossing.segment)) continue;
        const LeafEdge edge = leaf_edge_near(graph, grid, leaf, crossing.side, crossing.position);
        const double from = edge.at(grid, edge.from), to = edge.at(grid, edge.to), length = to - from;
        const double at = edge.along(crossing.position);
        const auto see = [&](std::int64_t end, double distance, Direction direction) {
          if (distance > sight_reach * length) return;
          sights.push_back(
              {edge.point(end), distance, length, crossing.segment, trace, p, direction, c == piece.entry});
        };
        see(edge.from, at - from, edge.vertical() ? Direction::north : Direction::east);
        see(edge.to, to - at, edge.vertical() ? Direction::south : Direction::west);
      }
    }
  }
  return sorted_by_corner(sights);
}

}  // namespace quadloop
