// Which of four nodes on one circle is joined to the others: grid lines decide, then the distance from the
// centre.
#include "mesher/cut/grid_rank.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace quadloop {
namespace {

const TreeGrid grid_of_one_tree({{0, 0}, {8, 8}}, 1, 1);
constexpr int finest = 3;  // leaves of edge 1

TEST(GridRank, TheCoarserTheLineTheHigher) {
  const auto rank = [](double x, double y) { return tie_rank(grid_of_one_tree, finest, {x, y}); };
  EXPECT_GT(rank(4, 4), rank(2, 2));
  EXPECT_GT(rank(2, 2), rank(1, 1));
  EXPECT_GT(rank(2, 2), rank(4, 1)) << "the finer one of a node's two lines counts first";
  EXPECT_GT(rank(4, 1), rank(2, 1));
  EXPECT_GT(rank(1, 1), rank(1.5, 0.25)) << "a node off the lattice";
}

TEST(GridRank, OfEqualLinesTheFartherFromTheCentre) {
  EXPECT_GT(tie_rank(grid_of_one_tree, finest, {1, 1}), tie_rank(grid_of_one_tree, finest, {3, 3}));
  EXPECT_GT(tie_rank(grid_of_one_tree, finest, {1.1, 1}), tie_rank(grid_of_one_tree, finest, {1.2, 1}));
}

TEST(GridRank, MirrorImagesDifferInTheirCoordinatesAlone) {
  for (const Point p : {Point{1, 2}, Point{4, 8}, Point{0.3, 5}, Point{0.3, 0.7}}) {
    for (const Point image :
         {Point{8 - p.x, p.y}, Point{p.x, 8 - p.y}, Point{p.y, p.x}, Point{8 - p.y, p.x}}) {
      TieRank own = tie_rank(grid_of_one_tree, finest, p), other = tie_rank(grid_of_one_tree, finest, image);
      EXPECT_TRUE(own != other || p == image);
      EXPECT_EQ(own.coarser, other.coarser);
      EXPECT_EQ(own.finer, other.finer);
      EXPECT_NEAR(own.farther, other.farther, 1e-15);
      EXPECT_NEAR(own.nearer, other.nearer, 1e-15);
    }
  }
}

// Two of the grid's lines have the same double there, the tree's are 2^22 apart.
TEST(GridRank, FarFromTheOriginTheTreesOwnLineIsTaken) {
  const Point corner{2e8 + 0.25, 2e8 + 0.25};
  constexpr int level = 8;
  constexpr std::int64_t step = std::int64_t{1} << (Quadrant::unit_level - level);
  for (const double size : {16.0, 3.0}) {
    const TreeGrid grid({corner, corner + Point{size, size}}, 1, 1);
    ASSERT_EQ(grid.x(step), grid.x(step + 1)) << "they do round to one";
    for (std::int64_t i = 0; i <= std::int64_t{1} << level; ++i) {
      const TieRank rank = tie_rank(grid, level, grid.corner(step * i, step)),
                    lines = line_rank(step * i, step);
      EXPECT_EQ(std::pair(rank.coarser, rank.finer), std::pair(lines.coarser, lines.finer)) << i;
      EXPECT_EQ(grid.column_on(grid.x(step * i), level), step * i);
      EXPECT_FALSE(grid.column_on(std::nextafter(grid.x(step * i), 0), level));
    }
  }
}

TEST(GridRank, LinesCountTrailingZeros) {
  EXPECT_EQ(line_rank(8, 4).coarser, line_rank(4, 8).coarser);
  EXPECT_GT(line_rank(8, 8), line_rank(8, 4));
  EXPECT_GT(line_rank(0, 0), line_rank(1 << 20, 1 << 20)) << "the root's own side is the coarsest";
}

}  // namespace
}  // namespace quadloop
