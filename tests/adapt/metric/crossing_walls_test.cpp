// Edges of the boundary that meet where they may not.
#include "adapt/metric/crossing_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace quadloop::adapt {
namespace {

std::vector<WallSpan> loop(const std::vector<Point>& points) {
  std::vector<WallSpan> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point a = points[i], b = points[(i + 1) % points.size()];
    edges.push_back({a.x, a.y, b.x, b.y, 0});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

TEST(CrossingWalls, LetsNeighboursMeetAtTheirEnds) {
  EXPECT_FALSE(crossing_walls(loop({{0, 0}, {1, 0.01}, {2, 0}, {1, 0.02}}), {}));
}

TEST(CrossingWalls, FindsBothSidesOfAThinIslandAcrossEachOther) {
  const auto met = crossing_walls(loop({{0, 0}, {1, 0.03}, {2, 0}, {1.5, 0.03}, {0.5, 0.01}}), {});
  ASSERT_TRUE(met);
  EXPECT_EQ(met->one.from(), (Point{1, 0.03}));
  EXPECT_EQ(met->other.from(), (Point{1.5, 0.03}));
}

TEST(CrossingWalls, FindsAnIslandOfTwoEdges) { EXPECT_TRUE(crossing_walls(loop({{0, 0}, {1, 0.1}}), {})); }

TEST(CrossingWalls, FindsAnEdgeFoldedBackOnTheOneBefore) {
  EXPECT_TRUE(crossing_walls(loop({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), {}));
}

TEST(CrossingWalls, LeavesOutWhatWasSoBefore) {
  const auto folded = loop({{0, 0}, {2, 0}, {1, 0}, {1, 1}});
  EXPECT_FALSE(crossing_walls(folded, folded));
}

}  // namespace
}  // namespace quadloop::adapt
