#include "mesher/geometry/interior.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

/// A square with a square lake on whose island is domain again.
Geometry lake_with_island() {
  const auto square = [](double half, bool counter_clockwise) {
    std::vector<Point> points{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    if (!counter_clockwise) std::swap(points[1], points[3]);
    return points;
  };
  std::vector<Point> points;
  for (const auto& loop : {square(4, true), square(3, false), square(1, true)})
    points.insert(points.end(), loop.begin(), loop.end());
  return {{{"shore"}}, points, {0, 4, 8, 12}, std::vector<BoundaryId>(12, BoundaryId{0})};
}

TEST(Interior, FollowsTheNesting) {
  const Geometry geometry = lake_with_island();
  const ShiftedOutline outline(geometry);
  const Interior interior(outline);
  for (double x = -5; x <= 5; x += 0.25) {
    for (double y = -5; y <= 5; y += 0.25) {
      const double ring = std::max(std::abs(x), std::abs(y));
      const bool on_outline = ring == 1 || ring == 3 || ring == 4;
      EXPECT_EQ(interior.contains({x, y}), !on_outline && (ring < 1 || (ring > 3 && ring < 4)))
          << x << " " << y;
    }
  }
}

TEST(Interior, TellsNeighbouringDoublesApart) {
  const Geometry geometry = lake_with_island();
  const ShiftedOutline outline(geometry);
  const Interior interior(outline);
  EXPECT_TRUE(interior.contains({std::nextafter(4, 0), 0.1}));
  EXPECT_FALSE(interior.contains({std::nextafter(4, 5), 0.1}));
  EXPECT_TRUE(interior.contains({std::nextafter(1, 0), 0.1}));
  EXPECT_FALSE(interior.contains({std::nextafter(1, 2), 0.1}));
}

}  // namespace
}  // namespace quadloop
