// One leaf, the unit square, against pieces of outline: the collinear and coincident cases of the thesis' Figs 3.10, 3.11 and 3.14.
#include <gtest/gtest.h>

#include <numeric>

#include "mesher/cut/leaf_cells.hpp"

namespace quadloop {
namespace {

const Box unit{{0, 0}, {1, 1}};

Geometry loops_of(const std::vector<std::vector<Point>>& loops, double corner = 30) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  for (const auto& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    starts.push_back(static_cast<std::int32_t>(points.size()));
  }
  std::vector<BoundaryId> boundary(points.size(), BoundaryId{0});
  return {{{"outline", 0, corner, "wall"}}, std::move(points), std::move(starts), std::move(boundary)};
}

struct Cut {
  bool sound = false;
  CutLeaf leaf;
  double area = 0;
  std::size_t cells = 0;
};

Cut cut_unit_square(const Geometry& geometry, unsigned hanging = 0) {
  const ShiftedOutline outline(geometry);
  const InsideTest inside(outline);
  std::vector<std::int32_t> segments;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (outline.meets(s, unit)) segments.push_back(s);
  }
  LeafTraces traces;
  traces.add(outline, unit, segments);
  LeafCutter cutter(outline, inside);
  Cut result;
  result.sound = cutter.cut({traces[0], {0.5, 0.5}, hanging, {}, {}}, Detail::merged);
  result.leaf = cutter.result();
  LeafCellMaker maker;
  LeafCells cells;
  result.sound = result.sound && maker.make({0, 0, 0}, unit, result.leaf, cells);
  const auto at = [&](std::int32_t n) { return result.leaf.nodes[static_cast<std::size_t>(n)].position; };
  for (const auto& t : cells.triangles) result.area += 0.5 * cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
  for (const auto& q : cells.quads) result.area += 0.5 * cross(at(q[2]) - at(q[0]), at(q[3]) - at(q[1]));
  result.cells = cells.triangles.size() + cells.quads.size();
  return result;
}

TEST(LeafCutter, ADiagonalCut) {
  const Cut cut = cut_unit_square(loops_of({{{-1, -0.5}, {2, 1}, {-1, 3}}}));  // the domain above the line y = x/2
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.leaf.outline.size(), 1U);
  EXPECT_NEAR(cut.area, 0.75, 1e-15);
}

TEST(LeafCutter, ASegmentAlongASideBelongsToTheDomainsSide) {
  const Cut inside = cut_unit_square(loops_of({{{0, -1}, {3, -1}, {3, 3}, {0, 3}}}));  // domain right of x = 0
  EXPECT_TRUE(inside.sound);
  EXPECT_EQ(inside.cells, 1U);
  EXPECT_EQ(inside.area, 1.0);
  EXPECT_EQ(inside.leaf.outline.size(), 1U);
  const Cut outside = cut_unit_square(loops_of({{{-3, -1}, {0, -1}, {0, 3}, {-3, 3}}}));  // domain left of x = 0
  EXPECT_TRUE(outside.sound);
  EXPECT_EQ(outside.cells, 0U);
  EXPECT_TRUE(outside.leaf.outline.empty());
}

TEST(LeafCutter, ASegmentAlongPartOfASideWithItsHangingNode) {
  const Cut cut = cut_unit_square(loops_of({{{0, 0.25}, {-1, -3}, {3, -3}, {3, 3}, {0, 3}}}), 1U << LeafGraph::left);
  EXPECT_TRUE(cut.sound);
  EXPECT_NEAR(cut.area, 1.0, 1e-15);
  EXPECT_GE(cut.leaf.outline.size(), 1U);
}

TEST(LeafCutter, ALineThroughTwoCorners) {
  const Cut cut = cut_unit_square(loops_of({{{-1, -1}, {2, 2}, {-1, 2}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.cells, 1U);
  EXPECT_EQ(cut.area, 0.5);
  EXPECT_EQ(cut.leaf.nodes.size(), 4U) << "crossings at corners are the corners";
}

TEST(LeafCutter, AVertexOnACorner) {
  const Cut cut = cut_unit_square(loops_of({{{1, 1}, {-2, 3}, {-2, -2}, {3, -2}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.area, 1.0);
}

TEST(LeafCutter, ACornerInsideIsKeptAndAWobbleIsNot) {
  const auto frame = [](Point a, Point b) { return std::vector<Point>{{-1, 0.5}, a, b, {2, 0.5}, {2, 3}, {-1, 3}}; };
  const Cut wobble = cut_unit_square(loops_of({frame({0.3, 0.501}, {0.6, 0.499})}));
  EXPECT_EQ(wobble.leaf.outline.size(), 1U);
  const Cut corner = cut_unit_square(loops_of({frame({0.3, 0.5}, {0.6, 0.9})}));
  EXPECT_GT(corner.leaf.outline.size(), 1U);
  EXPECT_TRUE(corner.sound);
}

TEST(LeafCutter, TwoBoundariesInOneLeaf) {
  const Cut cut = cut_unit_square(loops_of({{{-1, 0.25}, {2, 0.25}, {2, 0.75}, {-1, 0.75}}}));  // a channel through the leaf
  EXPECT_TRUE(cut.sound);
  EXPECT_NEAR(cut.area, 0.5, 1e-15);
  EXPECT_EQ(cut.leaf.outline.size(), 2U);
}

TEST(LeafCutter, AnIslandWithALakeInside) {
  const std::vector<Point> sea{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}};
  const std::vector<Point> island{{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}}, lake{{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}};
  const Cut cut = cut_unit_square(loops_of({sea, island, lake}));
  EXPECT_TRUE(cut.sound);
  EXPECT_TRUE(cut.leaf.refined) << "a whole loop in a leaf asks for finer leaves";
  EXPECT_NEAR(cut.area, 1 - 0.36 + 0.04, 1e-15);
}

TEST(LeafCutter, AThinWallAndATouchOfTheSide) {
  const Cut wall = cut_unit_square(loops_of({{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}, {{0.5, -1}, {0.5, 2}, {0.5000001, 2}, {0.5000001, -1}}}));
  EXPECT_TRUE(wall.sound);
  EXPECT_NEAR(wall.area, 1 - 1e-7, 1e-12);
  // A wedge of void whose tip lies on the right side of the leaf, from the right: the side gains a node, the leaf stays whole.
  const Cut tip = cut_unit_square(loops_of({{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}, {{1, 0.3}, {2, 0.4}, {2, 0.2}}}));
  EXPECT_TRUE(tip.sound);
  EXPECT_EQ(tip.area, 1.0);
  EXPECT_EQ(tip.leaf.nodes.size(), 5U);
}

TEST(LeafCutter, SpikesTouchingAtACornerSplitTheLoop) {
  // Two domains that meet in the leaf's corner (thesis Fig. 3.14): each is a loop of its own.
  const Cut cut = cut_unit_square(loops_of({{{0, 0}, {-0.1, -2}, {3, -2}, {2, 1}}, {{0, 1e-9}, {1, 2}, {-0.1, 2}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.leaf.loop_count(), 2U);
}

}  // namespace
}  // namespace quadloop
