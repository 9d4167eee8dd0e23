// Sides, corners and sites go round one way; the curve goes row by row.
#include "mesher/grid/square.hpp"

#include <gtest/gtest.h>

#include "mesher/grid/tree_grid.hpp"

namespace quadloop {
namespace {

constexpr Quadrant square{8, 16, Quadrant::unit_level - 2};  // of edge 4

TEST(Square, SitesGoRoundCounterClockwise) {
  for (const Side side : all_sides) {
    const GridPoint start = square.at(start_of(side)), middle = square.at(middle_of(side)),
                    end = square.at(start_of(next(side)));
    EXPECT_EQ(middle, (GridPoint{(start.x + end.x) / 2, (start.y + end.y) / 2}));
    EXPECT_EQ(is_vertical(side), start.x == end.x);
    EXPECT_EQ(square.line(side), is_vertical(side) ? start.x : start.y);
    EXPECT_EQ(square.line(side) - square.line(opposite(side)),
              side == Side::right || side == Side::top ? square.size() : -square.size());
    const GridPoint across = square.at(middle_of(opposite(side)));
    EXPECT_GT((end.x - start.x) * (across.y - start.y) - (end.y - start.y) * (across.x - start.x), 0)
        << "the square lies to the left";
  }
}

TEST(Square, SitesLieOnTheirSides) {
  for (const Site site : grid_sites) {
    const GridPoint p = square.at(site);
    EXPECT_EQ(site_at(halves_of(site)), site);
    EXPECT_EQ(sides_of(site).size(), is_corner(site) ? 2 : 1);
    EXPECT_NE(is_corner(site), is_middle(site));
    for (const Side side : all_sides)
      EXPECT_EQ(sides_of(site).contains(side), (is_vertical(side) ? p.x : p.y) == square.line(side));
  }
  for (const Side side : all_sides) {
    EXPECT_EQ(sides_of(elsewhere_on(side)), SideSet{side});
    EXPECT_EQ(side_of(elsewhere_on(side)), side);
    EXPECT_EQ(side_of(middle_of(side)), side);
    EXPECT_FALSE(is_on_grid(elsewhere_on(side)));
  }
  EXPECT_TRUE(sides_of(Site::inside).empty());
  EXPECT_EQ(site_at({1, 1}), Site::inside);
}

TEST(Square, TurnsTakeSidesAlong) {
  for (const Side bottom : all_sides) {
    EXPECT_EQ(turned(middle_of(Side::bottom), bottom), middle_of(bottom));
    EXPECT_EQ(turned(start_of(Side::bottom), bottom), start_of(bottom));
    EXPECT_EQ(turned(elsewhere_on(Side::bottom), bottom), elsewhere_on(bottom));
  }
  EXPECT_EQ(turned(Site::left_middle, Side::right), Site::bottom_middle);
  EXPECT_EQ(turned(Site::inside, Side::top), Site::inside);
}

TEST(Square, QuartersAreFoundByTheirSquaresAndFollowTheCurve) {
  int index = 0;
  for (const Corner quarter : corners_along_curve) {
    EXPECT_EQ(curve_index(quarter), index++);
    const Quadrant child = square.child(quarter);
    EXPECT_EQ(child.level, square.level + 1);
    EXPECT_TRUE(square.contains(child));
    EXPECT_EQ(child.at(site_of(quarter)), square.at(site_of(quarter)));
    EXPECT_EQ(quarter_at(child.x, child.y, square.level), quarter);
    EXPECT_EQ(quarter_at(child.x + child.size() - 1, child.y + child.size() - 1, square.level), quarter);
  }
}

TEST(Square, SetsOfSides) {
  const SideSet vertical{Side::left, Side::right}, corner{Side::left, Side::bottom};
  EXPECT_TRUE(vertical.has_opposites());
  EXPECT_TRUE((SideSet{Side::bottom, Side::top}.has_opposites()));
  EXPECT_FALSE(corner.has_opposites());
  EXPECT_EQ(vertical & corner, SideSet{Side::left});
  EXPECT_TRUE((SideSet{Side::top} & corner).empty());
}

}  // namespace
}  // namespace quadloop
