#include "mesher/geometry/predicates.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace quadloop
