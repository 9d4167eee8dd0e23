// One leaf, the unit square, against pieces of outline: the collinear and coincident cases of the thesis'
// Figs 3.10, 3.11 and 3.14.
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/leaf_cells.hpp"
#include "tests/cut/unit_box.hpp"
#include "tests/snap/traced_leaves.hpp"

namespace quadloop {
namespace {

using test::loops_of;

struct Cut {
  bool sound = false;
  CutLeaf leaf;
  double area = 0;
  std::size_t cells = 0;
};

Cut cut_box(const Geometry& geometry, const Box& box, SideSet hanging = {}) {
  const ShiftedOutline outline(geometry);
  const Interior inside(outline);
  std::vector<std::int32_t> segments;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (outline.meets(s, box)) segments.push_back(s);
  }
  LeafTraces traces;
  traces.add(outline, box, segments);
  LeafCutter cutter(outline, inside);
  Cut result;
  result.sound = cutter.cut({traces[0], 0.5 * (box.low + box.high), hanging, {}, {}}, Detail::merged);
  result.leaf = cutter.result();
  LeafCellMaker maker;
  LeafCells cells;
  result.sound = result.sound && maker.make({0, 0, 0}, box, result.leaf, cells);
  const auto at = [&](std::int32_t n) { return result.leaf.nodes[n].position; };
  for (const auto& t : cells.triangles) result.area += 0.5 * cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
  for (const auto& q : cells.quads) result.area += 0.5 * cross(at(q[2]) - at(q[0]), at(q[3]) - at(q[1]));
  result.cells = cells.triangles.size() + cells.quads.size();
  return result;
}

Cut cut_unit_square(const Geometry& geometry, SideSet hanging = {}) {
  return cut_box(geometry, test::unit_box, hanging);
}

using Points = std::vector<Point>;

/// The ends of the chords, in their order.
std::vector<std::pair<Point, Point>> chords_of(const Cut& cut) {
  std::vector<std::pair<Point, Point>> chords;
  const auto at = [&](std::int32_t n) { return cut.leaf.nodes[n].position; };
  for (const CutLeaf::Edge& e : cut.leaf.outline) chords.emplace_back(at(e.from), at(e.to));
  return chords;
}

/// The nodes of a loop, from the leftmost one on, the lowest of several.
Points places_of(const CutLeaf& leaf, std::span<const std::int32_t> loop) {
  Points places;
  for (const std::int32_t n : loop) places.push_back(leaf.nodes[n].position);
  std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
  return places;
}

/// The same of all loops, in order.
std::vector<Points> loops_in(const CutLeaf& leaf) {
  std::vector<Points> loops;
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) loops.push_back(places_of(leaf, leaf.loop(i)));
  std::sort(loops.begin(), loops.end());
  return loops;
}

TEST(LeafCutter, ADiagonalCut) {
  const Cut cut =
      cut_unit_square(loops_of({{{-1, -0.5}, {2, 1}, {-1, 3}}}));  // the domain above the line y = x/2
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.leaf.outline.size(), 1U);
  EXPECT_NEAR(cut.area, 0.75, 1e-15);
}

TEST(LeafCutter, ASegmentAlongASideBelongsToTheDomainsSide) {
  const Cut inside =
      cut_unit_square(loops_of({{{0, -1}, {3, -1}, {3, 3}, {0, 3}}}));  // domain right of x = 0
  EXPECT_TRUE(inside.sound);
  EXPECT_EQ(inside.cells, 1U);
  EXPECT_EQ(inside.area, 1.0);
  EXPECT_EQ(inside.leaf.outline.size(), 1U);
  const Cut outside =
      cut_unit_square(loops_of({{{-3, -1}, {0, -1}, {0, 3}, {-3, 3}}}));  // domain left of x = 0
  EXPECT_TRUE(outside.sound);
  EXPECT_EQ(outside.cells, 0U);
  EXPECT_TRUE(outside.leaf.outline.empty());
}

TEST(LeafCutter, ASegmentAlongPartOfASideWithItsHangingNode) {
  // The finer leaves across lie outside but for the lower one's lower half, so the hanging node is no cell's:
  // one chord passes it.
  const Cut cut = cut_unit_square(loops_of({{{0, 0.25}, {-1, -3}, {3, -3}, {3, 3}, {0, 3}}}), {Side::left});
  EXPECT_TRUE(cut.sound);
  EXPECT_NEAR(cut.area, 1.0, 1e-15);
  EXPECT_EQ(chords_of(cut), (std::vector<std::pair<Point, Point>>{{{0, 1}, {0, 0.25}}}));
  EXPECT_EQ(loops_in(cut.leaf), (std::vector<Points>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.25}}}));
}

TEST(LeafCutter, ASegmentAlongTwoFinerLeavesIsAnEdgeOfEach) {
  // Fig. 3.10(b): from a point on a side over the side's middle to its end, two edges; the domain lies on the
  // side of the finer leaves.
  const Geometry geometry = loops_of({{{0, 0.25}, {0, 3}, {-3, 3}, {-3, -3}, {3, -3}}});
  const Cut lower = cut_box(geometry, {{-0.5, 0}, {0, 0.5}}),
            upper = cut_box(geometry, {{-0.5, 0.5}, {0, 1}});
  EXPECT_TRUE(lower.sound && upper.sound);
  EXPECT_EQ(chords_of(lower), (std::vector<std::pair<Point, Point>>{{{0, 0.25}, {0, 0.5}}}));
  EXPECT_EQ(chords_of(upper), (std::vector<std::pair<Point, Point>>{{{0, 0.5}, {0, 1}}}));
  const Cut coarse = cut_unit_square(geometry, {Side::left});
  EXPECT_TRUE(coarse.sound);
  EXPECT_NEAR(coarse.area, 0.5 * 0.25 * 0.25 * 3 / 3.25, 1e-15)
      << "what lies below the line from (0, 0.25) to (3, -3)";
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
  const auto frame = [](Point a, Point b) {
    return std::vector<Point>{{-1, 0.5}, a, b, {2, 0.5}, {2, 3}, {-1, 3}};
  };
  const Cut wobble = cut_unit_square(loops_of({frame({0.3, 0.501}, {0.6, 0.499})}));
  EXPECT_EQ(wobble.leaf.outline.size(), 1U);
  const Cut corner = cut_unit_square(loops_of({frame({0.3, 0.5}, {0.6, 0.9})}));
  EXPECT_GT(corner.leaf.outline.size(), 1U);
  EXPECT_TRUE(corner.sound);
}

TEST(LeafCutter, TwoBoundariesInOneLeaf) {
  const Cut cut = cut_unit_square(
      loops_of({{{-1, 0.25}, {2, 0.25}, {2, 0.75}, {-1, 0.75}}}));  // a channel through the leaf
  EXPECT_TRUE(cut.sound);
  EXPECT_NEAR(cut.area, 0.5, 1e-15);
  EXPECT_EQ(cut.leaf.outline.size(), 2U);
}

TEST(LeafCutter, AnIslandWithALakeInside) {
  const std::vector<Point> sea{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}};
  const std::vector<Point> island{{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}},
      lake{{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}};
  const Cut cut = cut_unit_square(loops_of({sea, island, lake}));
  EXPECT_TRUE(cut.sound);
  EXPECT_TRUE(cut.leaf.refined) << "a whole loop in a leaf asks for finer leaves";
  EXPECT_NEAR(cut.area, 1 - 0.36 + 0.04, 1e-15);
}

TEST(LeafCutter, AThinWallAndATouchOfTheSide) {
  const Cut wall = cut_unit_square(loops_of(
      {{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}, {{0.5, -1}, {0.5, 2}, {0.5000001, 2}, {0.5000001, -1}}}));
  EXPECT_TRUE(wall.sound);
  EXPECT_NEAR(wall.area, 1 - 1e-7, 1e-12);
  // A wedge of void whose tip lies on the right side of the leaf, from the right: the side gains a node, the
  // leaf stays whole.
  const Cut tip =
      cut_unit_square(loops_of({{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}, {{1, 0.3}, {2, 0.4}, {2, 0.2}}}));
  EXPECT_TRUE(tip.sound);
  EXPECT_EQ(tip.area, 1.0);
  EXPECT_EQ(tip.leaf.nodes.size(), 5U);
}

TEST(LeafCutter, ATipOnASideNextToACornerLeavesTheLeafInTheDomain) {
  // Wedges of void from below whose tips lie on the bottom, as near to a corner as doubles can tell: the
  // middle between the two rounds to either of them.
  const double eps = std::numeric_limits<double>::epsilon();
  const Points sea{{-2, -2}, {5, -2}, {5, 5}, {-2, 5}};
  for (const double corner : {1.0, 1 + eps}) {
    const Cut tip =
        cut_box(loops_of({sea, {{corner + eps, 1}, {0.8, 0.2}, {0.4, 0.3}}}), Box{{corner, 1}, {2, 2}});
    EXPECT_TRUE(tip.sound) << (corner > 1);
    EXPECT_NEAR(tip.area, 1.0, 1e-14) << (corner > 1);
  }
}

TEST(LeafCutter, PartsThatMeetInOneNodeOfASideAreLoopsOfTheirOwn) {
  // Fig. 3.14: a wedge of void from the left, its tip on the right side.
  const Points sea{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}};
  const Cut cut = cut_unit_square(loops_of({sea, {{-1, 0.25}, {-1, 0.75}, {1, 0.5}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(loops_in(cut.leaf), (std::vector<Points>{{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.375}},
                                                     {{0, 0.625}, {1, 0.5}, {1, 1}, {0, 1}}}));
  EXPECT_NEAR(cut.area, 0.875, 1e-15);
}

TEST(LeafCutter, TwoDomainsThatMeetInACornerAreTwoLoops) {
  const Cut cut =
      cut_unit_square(loops_of({{{0, 0}, {-0.1, -2}, {3, -2}, {2, 1}}, {{0, 0}, {1, 2}, {-0.1, 2}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.leaf.loop_count(), 2U);
}

/// A leaf's loops from directed edges between places; nullopt where they do not close.
std::optional<std::vector<Points>> traced(const Points& places,
                                          const std::vector<std::pair<int, int>>& edges) {
  CutLeaf leaf;
  for (const Point p : places) leaf.nodes.push_back({p, Site::inside});
  std::vector<CutLeaf::Edge> directed;
  for (const auto& [from, to] : edges) directed.push_back({from, to, -1});
  leaf.loop_starts.assign(1, 0);
  if (!trace_loops(directed, leaf)) return std::nullopt;
  return loops_in(leaf);
}

/// All rotations of the edges: where the walk begins must not count.
void expect_traced(const Points& places, std::vector<std::pair<int, int>> edges,
                   const std::vector<Points>& expected) {
  for (std::size_t first = 0; first < edges.size(); ++first) {
    EXPECT_EQ(traced(places, edges), expected) << "from edge " << first;
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
}

TEST(TraceLoops, PartsOfTheDomainThatTouchAreLoopsOfTheirOwn) {
  const Points places{{0, 0}, {1, 0}, {0.5, 0.5}, {1, 1}, {0, 1}};  // an hourglass
  expect_traced(places, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 2}, {2, 0}},
                {{{0, 0}, {1, 0}, {0.5, 0.5}}, {{0, 1}, {0.5, 0.5}, {1, 1}}});
}

TEST(TraceLoops, ALoopThatTouchesItselfIsSplit) {
  // A hole that hangs on a node of the outline: one walk passes that node twice.
  const Points places{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.25}, {0.5, 0.5}, {0.25, 0.5}};
  const std::vector<Points> expected{{{0, 0}, {0.25, 0.5}, {0.5, 0.5}, {0.5, 0.25}},
                                     {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  expect_traced(places, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 6}, {6, 5}, {5, 4}, {4, 0}}, expected);
}

TEST(TraceLoops, ALoopThatTouchesItselfTwiceIsSplitTwice) {
  // Two holes, one hanging on a node of the outline, the other on a node of the first.
  const Points places{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}, {2, 2}, {2, 1}, {2, 3}, {3, 3}, {3, 2}};
  const std::vector<Points> expected{
      {{0, 0}, {1, 2}, {2, 2}, {2, 1}}, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{2, 2}, {2, 3}, {3, 3}, {3, 2}}};
  expect_traced(
      places,
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {4, 5}, {5, 6}, {6, 0}, {5, 7}, {7, 8}, {8, 9}, {9, 5}},
      expected);
}

TEST(TraceLoops, EdgesThatDoNotCloseAreNoLoops) {
  EXPECT_EQ(traced({{0, 0}, {1, 0}, {1, 1}}, {{0, 1}, {1, 2}}), std::nullopt);
}

TEST(LeafCutter, AnIslandThatTouchesASideIsAHoleOfTheLeaf) {
  const Points sea{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}, island{{0, 0.5}, {0.5, 0.75}, {0.5, 0.25}};
  const Cut cut = cut_unit_square(loops_of({sea, island}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(loops_in(cut.leaf), (std::vector<Points>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.5}},
                                                     {{0, 0.5}, {0.5, 0.75}, {0.5, 0.25}}}));
  EXPECT_NEAR(cut.area, 0.875, 1e-15);
}

/// A bay of this depth, 0.6 wide, in a shore along y = 0.5.
Cut cut_bay(double depth, double width = 0.6) {
  const double a = 0.5 - width / 2, b = 0.5 + width / 2;
  return cut_unit_square(
      loops_of({{{-1, 0.5}, {a, 0.5}, {0.5, 0.5 + depth}, {b, 0.5}, {2, 0.5}, {2, 3}, {-1, 3}}}, 180));
}

TEST(LeafCutter, PointsFromWhichAChordWouldStrayAreKept) {
  // No point is a corner; the outline may lie 0.15 of the leaf's edge from its chord.
  const Cut shallow = cut_bay(0.14), deep = cut_bay(0.16);
  EXPECT_EQ(chords_of(shallow), (std::vector<std::pair<Point, Point>>{{{0, 0.5}, {1, 0.5}}}));
  EXPECT_FALSE(shallow.leaf.refined);
  EXPECT_EQ(chords_of(deep),
            (std::vector<std::pair<Point, Point>>{{{0, 0.5}, {0.5, 0.66}}, {{0.5, 0.66}, {1, 0.5}}}));
  EXPECT_TRUE(deep.leaf.refined);
  EXPECT_TRUE(shallow.sound && deep.sound);
  EXPECT_NEAR(deep.area, 0.42, 1e-15);
}

TEST(LeafCutter, OfShortChordsLessIsAskedThanOfLongOnes) {
  // Once the bay's head is kept, its mouth lies 0.26 from the chords to the leaf's sides: they follow it too;
  // 0.2 of a chord is the other limit.
  const Cut cut = cut_bay(0.4, 0.2);
  const std::vector<std::pair<Point, Point>> expected{
      {{0, 0.5}, {0.4, 0.5}}, {{0.4, 0.5}, {0.5, 0.9}}, {{0.5, 0.9}, {0.6, 0.5}}, {{0.6, 0.5}, {1, 0.5}}};
  const auto chords = chords_of(cut);
  ASSERT_EQ(chords.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT(length(chords[i].second - expected[i].second), 1e-15);
  EXPECT_NEAR(cut.area, 0.46, 1e-15);
}

TEST(LeafCutter, DomainsNearlyMeetingInACornerAreTwoLoops) {
  // Two domains that nearly meet in the leaf's corner: each is a loop of its own.
  const Cut cut =
      cut_unit_square(loops_of({{{0, 0}, {-0.1, -2}, {3, -2}, {2, 1}}, {{0, 1e-9}, {1, 2}, {-0.1, 2}}}));
  EXPECT_TRUE(cut.sound);
  EXPECT_EQ(cut.leaf.loop_count(), 2U);
}

}  // namespace
}  // namespace quadloop
