#include "mesher/geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace quadloop {
namespace {

/// The filter's answer is the exact one, and obeys the laws of its contract.
void expect_exact(Point a, Point b, Point c) {
  const int turn = exact_orientation(a, b, c);
  EXPECT_EQ(orientation(a, b, c), turn);
  EXPECT_EQ(orientation(b, c, a), turn);
  EXPECT_EQ(orientation(b, a, c), -turn);
  EXPECT_EQ(orientation({-a.x, a.y}, {-b.x, b.y}, {-c.x, c.y}), -turn);
}

TEST(Orientation, IsExactBesideALine) {
  std::mt19937_64 random(11);
  const auto number = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < 2000; ++i) {
    const Point a{number(), number()}, b{number(), number()};
    const double share = number();
    Point c = a + share * (b - a);  // on the line but for rounding
    for (int step = -2; step <= 2; ++step) {
      expect_exact(a, b, c);
      c.y = std::nextafter(c.y, 2);
    }
  }
}

TEST(Orientation, IsExactWhereProductsUnderflowOrOverflow) {
  for (const double size :
       {std::numeric_limits<double>::denorm_min(), 0x1p-540, 0x1p-500, 0x1p-480, 1.0, 0x1p500, 0x1p520}) {
    expect_exact({0, 0}, {3 * size, 0}, {3 * size, size});
    expect_exact({0, 0}, {3 * size, size}, {6 * size, 2 * size});
    expect_exact({0, 0}, {5 * size, 3 * size}, {7 * size, 4 * size});
  }
}

TEST(Orientation, OfEqualPointsIsZero) {
  expect_exact({1, 2}, {1, 2}, {3, 4});
  expect_exact({1, 2}, {1, 2}, {1, 2});
}

TEST(Orientation, OfThingsOfVeryDifferentSize) {
  const double tiny = std::numeric_limits<double>::denorm_min(),
               large = std::numeric_limits<double>::max() / 4;
  expect_exact({-large, -large}, {large, large}, {tiny, tiny});
  EXPECT_EQ(orientation({-large, -large}, {large, large}, {tiny, tiny}), 0);
  EXPECT_EQ(orientation({-large, -large}, {large, large}, {0, tiny}), 1);
  EXPECT_EQ(orientation({-large, -large}, {large, large}, {tiny, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {tiny, large}, {0, large}), 1);
}

/// d lies on that side of the circle through a, b, c, and the laws of the contract hold.
void expect_side(int side, Point a, Point b, Point c, Point d) {
  EXPECT_EQ(in_circle(a, b, c, d), side);
  EXPECT_EQ(in_circle(b, c, a, d), side);
  EXPECT_EQ(in_circle(b, a, c, d), -side);
  EXPECT_EQ(in_circle(a, b, d, c), -side);
  const auto mirror = [](Point p) { return Point{-p.x, p.y}; };
  EXPECT_EQ(in_circle(mirror(a), mirror(b), mirror(c), mirror(d)), -side);
}

/// Four points of the circle of radius 65 round the origin, which has 36 points with whole coordinates.
constexpr std::array<Point, 4> on_circle{Point{16, 63}, {-33, 56}, {-39, -52}, {25, -60}};

TEST(InCircle, OfWholeNumbersAtEverySize) {
  int circles = 0;
  for (const int exponent : {-1074, -1060, -600, -300, -250, -30, 0, 30, 100, 300, 1000, 1015}) {
    for (const Point shift : {Point{0, 0}, Point{-1e3, 1e6}}) {
      std::array<Point, 5> p;
      for (std::size_t i = 0; i < 5; ++i) {
        const Point q = (i < 4 ? on_circle[i] : on_circle[3]) + shift;
        p[i] = {std::ldexp(q.x, exponent), std::ldexp(q.y, exponent)};
      }
      if (!std::isfinite(p[0].y)) continue;
      ++circles;
      expect_side(0, p[0], p[1], p[2], p[3]);
      p[4].y = std::nextafter(p[3].y, std::numeric_limits<double>::infinity());  // towards the centre
      if (shift.y == 0) expect_side(1, p[0], p[1], p[2], p[4]);
      p[4].y = std::nextafter(p[3].y, -std::numeric_limits<double>::infinity());
      if (shift.y == 0) expect_side(-1, p[0], p[1], p[2], p[4]);
    }
  }
  EXPECT_GE(circles, 22) << "the largest ones have no place in doubles";
}

TEST(InCircle, OneStepBesideARectangle) {
  const Point low{0.1, 0.2}, high{0.7, 0.9};  // no binary fractions: rounding hides on which side they lie
  const Point a = low, b{high.x, low.y}, c = high, d{low.x, high.y};
  expect_side(0, a, b, c, d);
  expect_side(0, a, c, d, b);
  expect_side(1, a, b, c, {std::nextafter(d.x, 1), d.y});
  expect_side(-1, a, b, c, {std::nextafter(d.x, 0), d.y});
  expect_side(1, a, b, c, {d.x, std::nextafter(d.y, 0)});
  expect_side(-1, a, b, c, {d.x, std::nextafter(d.y, 1)});
}

TEST(InCircle, OfThingsOfVeryDifferentSize) {
  const double tiny = std::numeric_limits<double>::denorm_min(), large = 0x1p1022;
  expect_side(1, {-large, 0}, {large, 0}, {0, large}, {tiny, tiny});
  expect_side(0, {-large, 0}, {large, 0}, {0, large}, {0, -large});
  expect_side(-1, {-large, 0}, {large, 0}, {0, large}, {tiny, -large});
  expect_side(1, {-large, 0}, {large, 0}, {0, large}, {0, -std::nextafter(large, 0)});
}

TEST(InCircle, OfEqualPointsIsZero) {
  const Point a{0.1, 0.2}, b{0.7, 0.3}, c{0.4, 0.9};
  expect_side(0, a, b, c, a);
  expect_side(0, a, b, b, c);
  expect_side(0, a, a, a, a);
}

}  // namespace
}  // namespace quadloop
