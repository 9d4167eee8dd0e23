// Edges between kept corners that are shorter than the smallest cells.
#include "mesher/build/short_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace quadloop {
namespace {

/// A body with a base of 1/16 at x = 4, as an island: clockwise.
std::vector<Point> body() { return {{4, 0.0625}, {4, 0}, {2, -1}, {0, 0}, {2, 1}}; }

Geometry outline(const std::vector<std::vector<Point>>& loops) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  for (const std::vector<Point>& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    starts.push_back(static_cast<std::int32_t>(points.size()));
  }
  std::vector<BoundaryId> of_segment(points.size(), BoundaryId{0});
  return {{Boundary{"wall"}}, std::move(points), std::move(starts), std::move(of_segment)};
}

TEST(ShortEdges, ABaseBelowTheSmallestCellBecomesOneVertexInItsMiddle) {
  std::vector<std::string> warnings;
  const std::optional<Geometry> merged = short_edges_merged(outline({body()}), 0.125, warnings);
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->size(), 4);
  EXPECT_EQ(merged->point(0), (Point{4, 0.03125}));
  EXPECT_EQ(merged->point(3), (Point{2, 1}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "1 edge between corners shorter than spacing.min = 0.125, the longest 0.0625 at (4, 0.03125) of "
            "boundary 'wall': the two ends became one node; make spacing.min smaller");
}

TEST(ShortEdges, ABaseThatCellsCanResolveStays) {
  std::vector<std::string> warnings;
  EXPECT_FALSE(short_edges_merged(outline({body()}), 0.0625, warnings));
  EXPECT_TRUE(warnings.empty());
}

TEST(ShortEdges, ABaseWithLayersStays) {
  const Geometry bare = outline({body()});
  Boundary wall{"wall"};
  wall.layers = LayerSpec{0.01, 1.2, 1.2, 4};
  const Geometry layered({wall}, {bare.points().begin(), bare.points().end()}, {0, 5},
                         std::vector<BoundaryId>(5, BoundaryId{0}));
  std::vector<std::string> warnings;
  EXPECT_FALSE(short_edges_merged(layered, 0.125, warnings));
  EXPECT_TRUE(warnings.empty());
}

TEST(ShortEdges, AnEndWhereAnotherBoundaryBeginsStaysInPlace) {
  const std::vector<Point> half{{0, 0}, {4, 0}, {6, 0}, {6, 4}, {-2, 4}, {-2, 0}};
  std::vector<Point> points = half;
  points.insert(points.begin() + 1, {{1, 1}, {4, 0.0625}});
  std::vector<BoundaryId> of_segment(points.size(), BoundaryId{1});
  for (const std::int32_t s : {0, 1, 2}) of_segment[s] = BoundaryId{0};
  const Geometry geometry({Boundary{"wall"}, Boundary{"axis"}}, points, {0, 8}, of_segment);
  std::vector<std::string> warnings;
  const std::optional<Geometry> merged = short_edges_merged(geometry, 0.125, warnings);
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->size(), 7);
  EXPECT_EQ(merged->point(2), (Point{4, 0})) << "not in the middle, which is not on the axis";
}

TEST(ShortEdges, TheEdgeThatClosesALoopIsMergedToo) {
  std::vector<Point> points = body();
  points.push_back(points.front());
  points.erase(points.begin());
  std::vector<std::string> warnings;
  const std::optional<Geometry> merged = short_edges_merged(outline({points}), 0.125, warnings);
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->size(), 4);
  EXPECT_EQ(merged->point(0), (Point{4, 0.03125}));
}

TEST(ShortEdges, NothingIsMergedWhereTheOutlineWouldTouchItself) {
  // the notch's floor, with a tip of another loop between the floor's left end and its middle
  const std::vector<Point> notch{{0, 0}, {8, 0}, {8, 4}, {5, 4}, {4.0625, 2}, {3.9375, 2}, {3.5, 4}, {0, 4}};
  const std::vector<Point> tip{{3.9765, 2.03}, {3.85, 2.6}, {3.97, 2.6}};
  std::vector<std::string> warnings;
  EXPECT_TRUE(short_edges_merged(outline({notch}), 0.25, warnings)) << "without the tip";
  warnings.clear();
  EXPECT_FALSE(short_edges_merged(outline({notch, tip}), 0.25, warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("triangles there may be thin"), std::string::npos) << warnings[0];
}

TEST(ShortEdges, ABaseOfSeveralSegmentsIsMergedAsAWhole) {
  std::vector<Point> points = body();
  points.insert(points.begin() + 1, {{4.001, 0.04}, {4.001, 0.02}});  // both turn by less than a corner
  std::vector<std::string> warnings;
  const std::optional<Geometry> merged = short_edges_merged(outline({points}), 0.125, warnings);
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->size(), 4);
  EXPECT_EQ(merged->point(0), (Point{4, 0.03125}));
  EXPECT_EQ(merged->point(1), (Point{2, -1}));
}

/// A box of 4 by 2 whose floor has the given points between its lower corners.
Geometry box_with(const std::vector<Point>& on_floor) {
  std::vector<Point> points{{0, 0}};
  points.insert(points.end(), on_floor.begin(), on_floor.end());
  for (const Point p : {Point{4, 0}, Point{4, 2}, Point{0, 2}}) points.push_back(p);
  return outline({points});
}

TEST(ShortEdges, ConsecutiveEdgesBecomeOneVertex) {
  std::vector<std::string> warnings;
  const auto notch =
      short_edges_merged(box_with({{2, 0}, {2, -0.0625}, {2.0625, -0.0625}, {2.0625, 0}}), 0.25, warnings);
  ASSERT_TRUE(notch);
  ASSERT_EQ(notch->size(), 5);
  EXPECT_EQ(notch->point(1), (Point{2.03125, 0}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "3 edges between corners shorter than spacing.min = 0.25, the longest 0.0625 at (2, -0.03125) of "
            "boundary 'wall': the two ends became one node; make spacing.min smaller");
}

TEST(ShortEdges, AnEdgeNearAnotherCornerIsMergedToo) {
  std::vector<std::string> warnings;
  const auto tab = short_edges_merged(box_with({{2, 0}, {2, 0.5}, {2.125, 0.5}, {2.125, 0}}), 0.25, warnings);
  ASSERT_TRUE(tab);
  EXPECT_EQ(tab->size(), 7);
  EXPECT_EQ(tab->point(2), (Point{2.0625, 0.5}));
}

TEST(ShortEdges, ALongRowOfFeaturePointsStays) {
  std::vector<Point> teeth;
  for (int i = 0; i < 40; ++i) teeth.push_back({1 + i / 20.0, i % 2 == 0 ? 0 : 0.1});
  std::vector<std::string> warnings;
  EXPECT_FALSE(short_edges_merged(box_with(teeth), 0.1125, warnings)) << "edges of 0.112";
  EXPECT_TRUE(warnings.empty());
  teeth.resize(4);
  EXPECT_TRUE(short_edges_merged(box_with(teeth), 0.1125, warnings)) << "four points";
  teeth.push_back({1.2, 0});
  EXPECT_FALSE(short_edges_merged(box_with(teeth), 0.1125, warnings)) << "five points";
}

TEST(ShortEdges, OfTwoEdgesWithACommonEndOneIsMergedFirst) {
  const std::vector<Point> step{{2, 0}, {2, 0.1875}, {2.1875, 0.1875}, {2.1875, 1}};
  std::vector<std::string> warnings;
  const auto merged = short_edges_merged(box_with(step), 0.2, warnings);
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->size(), 7);
  EXPECT_EQ(merged->point(1), (Point{2, 0.09375}));
  EXPECT_EQ(merged->point(2), step[2]) << "0.21 from the new vertex";
}

TEST(ShortEdges, ABaseWithADentThatHoldsAnotherLoopStays) {
  std::vector<Point> dented{{5, -2}, {0, 0}, {5, 2}, {10, 0.25}};
  for (int i = 1; i < 8; ++i) {
    const double angle = std::numbers::pi * (0.5 + i / 8.0);
    dented.push_back({10 + 0.25 * std::cos(angle), 0.25 * std::sin(angle)});
  }
  dented.push_back({10, -0.25});
  const std::vector<Point> loop_in_dent{{9.85, 0}, {9.9, 0.02}, {9.9, -0.02}};
  std::vector<std::string> warnings;
  const std::optional<Geometry> merged = short_edges_merged(outline({dented}), 0.9, warnings);
  ASSERT_TRUE(merged) << "without the other loop";
  EXPECT_EQ(merged->size(), 4);
  EXPECT_FALSE(short_edges_merged(outline({dented, loop_in_dent}), 0.9, warnings));
}

TEST(ShortEdges, TheOnlyEdgeOfABoundaryStays) {
  const Geometry plain = outline({body()});
  std::vector<BoundaryId> of_segment(5, BoundaryId{0});
  of_segment[0] = BoundaryId{1};
  const Geometry named({Boundary{"wall"}, Boundary{"base"}}, {plain.points().begin(), plain.points().end()},
                       {0, 5}, of_segment);
  std::vector<std::string> warnings;
  EXPECT_FALSE(short_edges_merged(named, 0.125, warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("boundary 'base'"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace quadloop
