#include "mesher/cut/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {
namespace {

std::vector<LocalTriangle> triangulated(const std::vector<Point>& points, const std::vector<TieRank>& ranks) {
  std::vector<std::int32_t> loop(points.size());
  std::iota(loop.begin(), loop.end(), 0);
  const std::span<const std::int32_t> whole(loop);
  Triangulator triangulator;
  std::vector<LocalTriangle> triangles;
  EXPECT_TRUE(triangulator.triangulate(
      points, [&](std::int32_t node) { return ranks[node]; }, std::span(&whole, 1), triangles));
  return triangles;
}

std::vector<Point> random_star(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> radius(0.3, 1.0);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count, r = radius(random);
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return points;
}

double area_of(const std::vector<Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) twice += cross(points[i], points[(i + 1) % points.size()]);
  return 0.5 * twice;
}

TEST(Triangulate, AreaInIsAreaOutAndEveryTriangleIsPositive) {
  std::mt19937_64 random(1);
  for (const int count : {3, 4, 5, 8, 24, 25, 60, 300}) {
    const auto points = random_star(random, count);
    const auto triangles = triangulated(points, std::vector<TieRank>(points.size()));
    EXPECT_EQ(triangles.size(), points.size() - 2);
    double area = 0;
    const auto at = [&](std::int32_t n) { return points[n]; };
    for (const auto& t : triangles) {
      EXPECT_GT(orientation(at(t[0]), at(t[1]), at(t[2])), 0);
      area += 0.5 * cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    }
    EXPECT_NEAR(area, area_of(points), 1e-12);
  }
}

TEST(Triangulate, InnerEdgesAreLocallyDelaunay) {
  std::mt19937_64 random(2);
  int edges = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto points = random_star(random, 6 + trial);
    const auto triangles = triangulated(points, std::vector<TieRank>(points.size()));
    const auto at = [&](std::int32_t n) { return points[n]; };
    for (const auto& t : triangles) {
      for (const auto& other : triangles) {
        std::vector<std::int32_t> apart;
        for (const std::int32_t n : other) {
          if (std::find(t.begin(), t.end(), n) == t.end()) apart.push_back(n);
        }
        if (apart.size() == 1) {
          EXPECT_LE(in_circle(at(t[0]), at(t[1]), at(t[2]), at(apart[0])), 0);
          ++edges;
        }
      }
    }
  }
  EXPECT_GT(edges, 50);
}

TEST(Triangulate, TheHighestRankTakesTheDiagonalOfASquare) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t best = 0; best < 4; ++best) {
    std::vector<TieRank> ranks(4);
    ranks[best].coarser = 5;
    for (const auto& t : triangulated(square, ranks))
      EXPECT_NE(std::find(t.begin(), t.end(), static_cast<std::int32_t>(best)), t.end());
  }
}

TEST(Triangulate, PointsOnAStraightSideGiveNoFlatTriangle) {
  const std::vector<Point> points{{0, 0}, {0.25, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}};
  EXPECT_EQ(triangulated(points, std::vector<TieRank>(points.size())).size(), 5U);
}

}  // namespace
}  // namespace quadloop
