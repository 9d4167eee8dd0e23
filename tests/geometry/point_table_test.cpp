#include "mesher/geometry/point_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace quadloop {
namespace {

/// Points that come ever closer to the origin, as leaves do at a wall; no two are equal.
std::vector<Point> graded_points(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double size = std::ldexp(1.0, -(i % 20));
    points.push_back({size * (count + i), size * (i % 7)});
  }
  return points;
}

TEST(PointTable, FindsPointsByTheirCoordinatesAlone) {
  const std::vector<Point> known{{1, 2}, {0.0, 3}, {2, 1}, {1, 2}, {1, std::nextafter(2.0, 3.0)}};
  const std::vector<Point> points{{2, 1}, {1, 2}, {1, 1}, {-0.0, 3}, {1, std::nextafter(2.0, 1.0)}, known[4]};
  EXPECT_EQ(find_equal_points(known, points), (std::vector<std::int32_t>{2, 0, -1, 1, -1, 4}));
  EXPECT_EQ(find_equal_points({}, points), std::vector<std::int32_t>(points.size(), -1));
}

TEST(PointTable, FindsEachOfManyAtItsOwnPlace) {
  const std::vector<Point> many = graded_points(5000);
  std::vector<std::int32_t> own(many.size());
  std::iota(own.begin(), own.end(), 0);
  EXPECT_EQ(find_equal_points(many, many), own);
}

TEST(PointTable, TellsWhetherAnyPointIsThereTwice) {
  std::vector<Point> points = graded_points(5000);
  EXPECT_FALSE(PointTable(points).any_twice());
  EXPECT_FALSE(PointTable({}).any_twice());
  points.push_back({points[17].x, std::nextafter(points[17].y, 9.0)});
  EXPECT_FALSE(PointTable(points).any_twice());
  points[3200] = points[17];
  EXPECT_TRUE(PointTable(points).any_twice());
  EXPECT_TRUE(PointTable(std::vector<Point>{{0.0, 1}, {-0.0, 1}}).any_twice());
}

}  // namespace
}  // namespace quadloop
