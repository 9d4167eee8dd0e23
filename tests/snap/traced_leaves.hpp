#pragma once

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "mesher/forest/leaf_finder.hpp"
#include "mesher/snap/snap_corners.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// Outlines with the domain to their left as a geometry of one boundary, on which points that turn by more
/// than `corner` degrees are kept.
inline Geometry loops_of(const std::vector<std::vector<Point>>& loops, double corner = 30) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  for (const auto& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    starts.push_back(size32(points));
  }
  std::vector<BoundaryId> boundary(points.size(), BoundaryId{0});
  return {{{"outline", 0, corner, "wall"}}, std::move(points), std::move(starts), std::move(boundary)};
}

/// The square of edge 4 at `low` in leaves of edge 1, or of edge 2 outside of `fine`, and the outline in
/// them. What it is asked for is the same on any number of ranks. *Collective*, all of it.
class TracedLeaves {
 public:
  static constexpr std::int64_t unit = std::int64_t{1} << (Quadrant::unit_level - 2);  ///< of length 1

  explicit TracedLeaves(Geometry given, const Box& fine = {{0, 0}, {4, 4}}, Point low = {})
      : grid{{low, low + Point{4, 4}}, 1, 1},
        geometry{std::move(given)},
        outline{geometry},
        graph{world(), grid, refined(fine)},
        traced{graph.size()} {
    for (const LeafId leaf : graph.all()) {
      const Box box = grid.box_of(graph.leaf(leaf));
      std::vector<std::int32_t> segments;
      for (std::int32_t s = 0; s < geometry.size(); ++s) {
        if (outline.meets(s, box)) segments.push_back(s);
      }
      if (!segments.empty()) traced.add(leaf, outline, box, segments);
    }
  }

  /// Whether a leaf of this rank touches the grid vertex, or holds it on a side.
  bool at_local_leaf(GridPoint corner) const {
    const auto round = LeafFinder(graph).leaves_round(corner);
    return std::any_of(round.begin(), round.end(), [&](LeafId leaf) { return graph.is_local(leaf); });
  }

  const TreeGrid grid;
  Geometry geometry;
  ShiftedOutline outline;
  LeafGraph graph;
  TracedForest traced;

 private:
  Forest refined(const Box& fine) const {
    Forest forest(world(), grid);
    const auto splits = [&](const Quadrant& q) {
      const Point centre = grid.box_of(q).centre();
      return q.level < 1 || fine.contains(centre);
    };
    forest.refine(splits, 2);
    forest.partition();
    return forest;
  }
};

}  // namespace quadloop::test
