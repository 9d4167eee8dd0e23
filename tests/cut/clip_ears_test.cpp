// Rings of few nodes, which are clipped ear by ear: whatever their shape, and wherever they begin.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesher/cut/triangulate.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {
namespace {

using Ring = std::vector<std::int32_t>;

bool is_simple(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (on_segment(points[(i + 2) % n], points[i], points[(i + 1) % n])) return false;
    if (on_segment(points[i], points[(i + 1) % n], points[(i + 2) % n])) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && segments_meet(points[i], points[i + 1], points[j], points[(j + 1) % n]))
        return false;
    }
  }
  return true;
}

double twice_area(const std::vector<Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) twice += cross(points[i], points[(i + 1) % points.size()]);
  return twice;
}

/// Counter-clockwise simple polygons over places of a small grid, so that many of their nodes are in line.
std::vector<std::vector<Point>> grid_polygons(std::size_t count) {
  std::mt19937 random(7);
  std::vector<Point> places;
  for (int i = 0; i < 16; ++i) places.push_back({i % 4 * 1.0, i / 4 * 1.0});
  std::vector<std::vector<Point>> polygons;
  while (polygons.size() < count) {
    std::shuffle(places.begin(), places.end(), random);
    std::vector<Point> points(places.begin(), places.begin() + 4 + random() % 6);
    if (!is_simple(points)) continue;
    if (twice_area(points) < 0) std::reverse(points.begin(), points.end());
    polygons.push_back(points);
  }
  return polygons;
}

/// Triangles of a ring that name no edge of it twice and each inner one from both sides.
void expect_tiles(const std::vector<Point>& points, const std::vector<LocalTriangle>& triangles) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  double twice = 0;
  for (const auto& t : triangles) {
    const Point a = points[t[0]], b = points[t[1]], c = points[t[2]];
    EXPECT_GT(orientation(a, b, c), 0);
    twice += cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  EXPECT_EQ(twice, twice_area(points));
  std::size_t outer = 0;
  for (const auto& [from, to] : edges) {
    EXPECT_EQ(std::count(edges.begin(), edges.end(), std::pair{from, to}), 1);
    outer += std::count(edges.begin(), edges.end(), std::pair{to, from}) == 0 ? 1U : 0U;
  }
  EXPECT_EQ(outer, points.size());
}

TEST(ClipEars, EverySmallPolygonIsTiledWhereverItsRingBegins) {
  for (const auto& points : grid_polygons(400)) {
    Ring ring(points.size());
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<std::int32_t>(i);
    std::vector<TieRank> ranks(points.size());
    for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i] = tie_rank({1.5, 1.5}, points[i]);
    std::vector<LocalTriangle> first;
    for (std::size_t turn = 0; turn < ring.size(); ++turn) {
      const std::span<const std::int32_t> loop(ring);
      std::vector<LocalTriangle> triangles;
      ASSERT_TRUE(Triangulator{}.triangulate(
          points, [&](std::int32_t node) { return ranks[node]; }, std::span(&loop, 1), triangles));
      EXPECT_EQ(triangles.size(), points.size() - 2);
      if (turn == 0) {
        first = triangles;
        expect_tiles(points, triangles);
      }
      EXPECT_EQ(triangles, first) << "the triangulation is unique";
      std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    }
  }
}

TEST(ClipEars, TheSmallestSineIsThatOfTheSmallestAngle) {
  const auto sine = [](const std::vector<Point>& points, Ring ring) {
    const std::span<const std::int32_t> loop(ring);
    Triangulator triangulator;
    std::vector<LocalTriangle> triangles;
    EXPECT_TRUE(triangulator.triangulate(
        points, [](std::int32_t) { return TieRank{}; }, std::span(&loop, 1), triangles));
    return triangulator.smallest_sine();
  };
  const std::vector<Point> points{{10, 20}, {14, 20}, {10, 23}, {10, 20.0001}};  // 3, 4, 5
  const std::vector<Point> turned{{-20, 10}, {-20, 14}, {-23, 10}};
  EXPECT_NEAR(sine(points, {0, 1, 2}), 0.6, 1e-14);
  EXPECT_NEAR(sine({points[1], points[2], points[0]}, {0, 1, 2}), 0.6, 1e-14);
  EXPECT_NEAR(sine({points[2], points[0], points[1]}, {0, 1, 2}), 0.6, 1e-14);
  EXPECT_NEAR(sine(turned, {0, 1, 2}), 0.6, 1e-14);
  EXPECT_NEAR(sine({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {0, 1, 2, 3}), std::sqrt(0.5), 1e-14);
  EXPECT_LT(sine(points, {0, 1, 3}), 1e-4) << "the worst angle counts, however small";
  EXPECT_NEAR(sine({{0, 0}, {9, 0}, {9, 1}, {0, 8}}, {0, 1, 2, 3}), 1 / std::sqrt(82), 1e-14)
      << "and of all triangles";
}

}  // namespace
}  // namespace quadloop
