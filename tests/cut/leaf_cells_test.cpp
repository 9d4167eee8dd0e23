// Which cells a leaf gets: quadrilaterals in good shape, or triangles; templates at hanging nodes.
#include "mesher/cut/leaf_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "mesher/base/error.hpp"
#include "mesher/cut/grid_rank.hpp"
#include "tests/cut/unit_box.hpp"

namespace quadloop {
namespace {

using test::unit_box;

constexpr double degree = std::numbers::pi / 180;

const Quadrant quadrant{0, 0, 3};
constexpr std::array<Site, 4> corners{Site::south_west, Site::south_east, Site::north_east, Site::north_west};

CutLeaf leaf_of(const std::vector<CutLeaf::Node>& nodes) {
  CutLeaf leaf;
  leaf.nodes = nodes;
  leaf.loop_starts = {0, static_cast<std::int32_t>(nodes.size())};
  leaf.loop_blocks = {0};
  for (std::size_t i = 0; i < nodes.size(); ++i) leaf.loop_nodes.push_back(static_cast<std::int32_t>(i));
  return leaf;
}

/// How many quadrilaterals a loop of four nodes gives, of a whole leaf or of a cut one: 1, or 0 for
/// triangles. It must not depend on its size nor on where it begins.
std::size_t quads_of(std::array<Point, 4> places, bool whole) {
  const auto count = [&](double scale) {
    std::vector<CutLeaf::Node> nodes;
    for (std::size_t i = 0; i < 4; ++i)
      nodes.push_back({scale * places[i], whole ? corners[i] : Site::inside});
    LeafCellMaker maker;
    LeafCells cells;
    EXPECT_TRUE(maker.make(quadrant, unit_box, leaf_of(nodes), cells));
    EXPECT_EQ(cells.triangles.size(), cells.quads.empty() ? 2U : 0U);
    return cells.quads.size();
  };
  const std::size_t quads = count(1);
  for (int turn = 0; turn < 4; ++turn) {
    for (const double scale : {0.125, 8.0}) EXPECT_EQ(count(scale), quads) << turn << ' ' << scale;
    std::rotate(places.begin(), places.begin() + 1, places.end());
  }
  return quads;
}

std::array<Point, 4> rhombus(double angle) {
  const Point up{std::cos(angle * degree), std::sin(angle * degree)};
  return {Point{0, 0}, {1, 0}, Point{1, 0} + up, up};
}

TEST(LeafCells, QuadrilateralsStayWhereNoCornerIsFarFromARightAngle) {
  EXPECT_EQ(quads_of(rhombus(90), false), 1U);
  EXPECT_EQ(quads_of(rhombus(51), false), 1U);
  EXPECT_EQ(quads_of(rhombus(49), false), 0U) << "40 degrees in a cut leaf";
  EXPECT_EQ(quads_of(rhombus(41), true), 1U);
  EXPECT_EQ(quads_of(rhombus(39), true), 0U) << "50 degrees in a whole one";
  const double half = 22.5 * degree;
  const std::array<Point, 4> kite{
      Point{0, 0}, {std::cos(half), -std::sin(half)}, {1.2, 0}, {std::cos(half), std::sin(half)}};
  EXPECT_EQ(quads_of(kite, false), 0U) << "one corner of 45 degrees, the others near 105";
  EXPECT_EQ(quads_of(kite, true), 1U);
}

TEST(LeafCells, ADartIsNoQuadrilateral) {
  // Angles of 45, 45, 45 and 225 degrees: none is farther than 50 from a right angle or three of them.
  const double half = 22.5 * degree, s = std::sin(half), c = std::cos(half);
  EXPECT_EQ(quads_of({Point{0, 0}, {c, -s}, {c - s * std::tan(half), 0}, {c, s}}, true), 0U);
}

TEST(LeafCells, TheSmallestSineIsThatOfAllLoops) {
  CutLeaf leaf = leaf_of({{{0, 0}, Site::inside}, {{1, 0}, Site::inside}, {{0, 0.1}, Site::inside}});
  leaf.nodes.insert(leaf.nodes.end(),
                    {{{1, 1}, Site::inside}, {{0, 1}, Site::inside}, {{1, 0.5}, Site::inside}});
  leaf.loop_nodes.insert(leaf.loop_nodes.end(), {3, 4, 5});
  leaf.loop_starts.push_back(6);
  leaf.loop_blocks.push_back(0);
  LeafCellMaker maker;
  LeafCells cells;
  ASSERT_TRUE(maker.make(quadrant, unit_box, leaf, cells));
  EXPECT_EQ(cells.triangles.size(), 2U);
  EXPECT_EQ(cells.triangle_blocks, (std::vector<std::int32_t>{0, 0}));
  EXPECT_NEAR(maker.smallest_sine(), 0.1 / std::sqrt(1.01), 1e-15);
  leaf.loop_blocks = {3, 1};
  ASSERT_TRUE(maker.make(quadrant, unit_box, leaf, cells));
  EXPECT_EQ(cells.triangle_blocks, (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(cells.triangles[0], (LocalTriangle{3, 4, 5}));
}

Point place_of(Site site) {
  const Quadrant two{0, 0, Quadrant::unit_level - 1};  // of edge 2
  const auto at = two.at(site);
  return {0.5 * static_cast<double>(at.x), 0.5 * static_cast<double>(at.y)};
}

TEST(HangingTemplates, TileTheLeafAndTakeEveryHangingNode) {
  for (const Side side : all_sides) {
    for (const SideSet hanging : {SideSet{side}, SideSet{side, next(side)}}) {
      const auto triangles = hanging_template(hanging);
      const bool two = hanging.contains(next(side));
      EXPECT_EQ(triangles.size(), two ? 4U : 3U);
      double area = 0;
      std::vector<Site> used;
      for (const SiteTriangle& t : triangles) {
        const double twice = cross(place_of(t[1]) - place_of(t[0]), place_of(t[2]) - place_of(t[0]));
        EXPECT_GT(twice, 0);
        area += 0.5 * twice;
        used.insert(used.end(), t.begin(), t.end());
      }
      EXPECT_EQ(area, 1);
      for (const Side s : all_sides) {
        const bool found = std::find(used.begin(), used.end(), middle_of(s)) != used.end();
        EXPECT_EQ(found, hanging.contains(s));
      }
    }
  }
  EXPECT_THROW(hanging_template({Side::left, Side::right}), Fault);
}

TEST(LineRank, TheCoarserTheLinesTheHigher) {
  const std::int64_t unit = std::int64_t{1} << Quadrant::unit_level;
  const auto ranks = [](std::int64_t column, std::int64_t row) {
    const TieRank rank = line_rank(column, row);
    EXPECT_EQ(rank.farther, 0);
    EXPECT_EQ(rank.nearer, 0);
    EXPECT_EQ(rank.x, 0);
    EXPECT_EQ(rank.y, 0);
    return std::pair<int, int>(rank.coarser, rank.finer);
  };
  EXPECT_EQ(ranks(1, 4), std::pair(0, 2));
  EXPECT_EQ(ranks(24, 2), std::pair(1, 3));
  EXPECT_EQ(ranks(0, unit), std::pair(Quadrant::unit_level, Quadrant::unit_level));
  EXPECT_EQ(ranks(4 * unit, 0), std::pair(Quadrant::unit_level, Quadrant::unit_level));
}

TEST(TieRank, OnlyNodesOnLinesOfTheTreeHaveThoseOfTheLattice) {
  const TreeGrid grid({{0, 0}, {4, 4}}, 1, 1);
  const int shift = Quadrant::unit_level - 3;  // lines of the third level, half a unit of length apart
  const auto lines = [&](Point p) {
    const TieRank rank = tie_rank(grid, 3, p);
    EXPECT_EQ(rank.farther, std::max(std::abs(p.x - 2), std::abs(p.y - 2)));
    EXPECT_EQ(rank.x, p.x);
    return std::pair<int, int>(rank.coarser, rank.finer);
  };
  EXPECT_EQ(lines({1, 0.5}), std::pair(shift, shift + 1));
  EXPECT_EQ(lines({0.5, 3}), std::pair(shift, shift + 1));
  EXPECT_EQ(lines({2, 1}), std::pair(shift + 1, shift + 2));
  EXPECT_EQ(lines({1, 0.25}), std::pair(-1, -1)) << "on a line of the next level";
  EXPECT_EQ(lines({1, 0.3}), std::pair(-1, -1));
  EXPECT_EQ(lines({0.3, 1}), std::pair(-1, -1));
}

}  // namespace
}  // namespace quadloop
