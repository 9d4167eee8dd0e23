// Triangles between two polylines: they fill the strip, each edge has one, and they are as good as can be.
#include "mesher/layers/zipper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace quadloop {
namespace {

using Line = std::vector<Point>;

std::array<Point, 3> corners_of(const ZipperTriangle& t, const Line& first, const Line& second, bool left) {
  const Point a = first[t.first], b = second[t.second];
  const Point c = t.on_first ? first[t.first + 1] : second[t.second + 1];
  return left ? std::array{a, c, b} : std::array{a, b, c};
}

double area(const std::array<Point, 3>& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }

/// Whether all are positive; the sum of their areas.
double filled(const Line& first, const Line& second, bool left) {
  double sum = 0;
  for (const ZipperTriangle& t : zipper(first, second, left)) {
    const double of_one = area(corners_of(t, first, second, left));
    EXPECT_GT(of_one, 0);
    sum += of_one;
  }
  return sum;
}

Line evenly(Point from, Point to, int parts) {
  Line line;
  for (int i = 0; i <= parts; ++i) line.push_back(from + (i / static_cast<double>(parts)) * (to - from));
  return line;
}

TEST(Zipper, FillsTheStripWhicheverSideHasMoreEdges) {
  for (const int below : {1, 3, 8}) {
    for (const int above : {1, 5, 8, 20}) {
      const Line first = evenly({0, 0}, {8, 0}, below), second = evenly({0, 1}, {8, 1}, above);
      EXPECT_EQ(zipper(first, second, true).size(), static_cast<std::size_t>(below + above));
      EXPECT_NEAR(filled(first, second, true), 8, 1e-12);
    }
  }
}

TEST(Zipper, EachEdgeHasOneTriangleInOrder) {
  const Line first = evenly({0, 0}, {8, 0}, 5), second = evenly({0, 1}, {8, 1}, 9);
  std::int32_t on_first = 0, on_second = 0;
  for (const ZipperTriangle& t : zipper(first, second, true)) {
    EXPECT_EQ(t.first, on_first);
    EXPECT_EQ(t.second, on_second);
    ++(t.on_first ? on_first : on_second);
  }
  EXPECT_EQ(on_first, 5);
  EXPECT_EQ(on_second, 9);
}

void expect_mirrored(const Line& first, const Line& second) {
  Line below;
  for (const Point p : second) below.push_back({p.x, -p.y});
  Line axis;
  for (const Point p : first) axis.push_back({p.x, -p.y});
  const auto above = zipper(first, second, true), mirror = zipper(axis, below, false);
  ASSERT_EQ(above.size(), mirror.size());
  ASSERT_EQ(above.size(), first.size() + second.size() - 2);
  for (std::size_t i = 0; i < above.size(); ++i) EXPECT_EQ(above[i].on_first, mirror[i].on_first) << i;
  EXPECT_NEAR(filled(axis, below, false), filled(first, second, true), 1e-12);
}

TEST(Zipper, IsMirroredOnTheOtherSide) {
  expect_mirrored({{0, 0}, {1, 0.1}, {2.2, 0}, {3, 0}}, {{0.2, 1}, {0.8, 1.2}, {1.7, 1}, {3.1, 0.9}});
}

TEST(Zipper, IsMirroredToTheLastBitWhereDiagonalsAreEquallyLong) {
  for (int parts = 3; parts < 60; ++parts)
    expect_mirrored(evenly({0.1, 0}, {0.7, 0}, parts), evenly({0.1, 0.07}, {0.7, 0.07}, parts));
}

TEST(Zipper, MayBeginAtOnePoint) {
  const Line first{{0, 0}, {1, 0}, {2, 0}}, second{{0, 0}, {1, 0.8}, {2, 1}};
  const auto triangles = zipper(first, second, true);
  ASSERT_EQ(triangles.size(), 3U);
  EXPECT_FALSE(triangles[0].on_first);
  EXPECT_EQ(triangles[0].first, 1);
  EXPECT_NEAR(filled(first, second, true), 0.4 + 0.9, 1e-12);
}

TEST(Zipper, TakesTheBetterDiagonals) {
  const Line first{{0, 0}, {1, 0}, {2, 0}}, second{{0.5, 1}, {1.5, 1}};
  const auto triangles = zipper(first, second, true);
  ASSERT_EQ(triangles.size(), 3U);
  EXPECT_TRUE(triangles[0].on_first && !triangles[1].on_first && triangles[2].on_first);
}

TEST(Zipper, GoesRoundACorner) {
  const Line first{{0, 0}, {1, 0}, {1, -1}}, second{{0, 1}, {1, 1}, {2, 1}, {2, 0}, {2, -1}};
  EXPECT_NEAR(filled(first, second, true), 3, 1e-12);
}

}  // namespace
}  // namespace quadloop
