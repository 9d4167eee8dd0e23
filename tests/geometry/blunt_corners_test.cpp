#include "mesher/geometry/blunt_corners.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop {
namespace {

TEST(BluntCorners, AreNamedByBits) {
  const Point a{0, 0}, b{1, 0}, right{0, 1}, obtuse{-1, 1}, acute{0.5, 1};
  EXPECT_EQ(blunt_corners(a, b, acute), 0U);
  EXPECT_EQ(blunt_corners(a, b, right), 1U);  // a right angle may be blunt
  EXPECT_EQ(blunt_corners(obtuse, a, b), 2U);
  EXPECT_EQ(blunt_corners(b, obtuse, a), 4U);
}

/// Rounding never makes an acute angle of a right or a wider one.
TEST(BluntCorners, AreSureOfAcuteAnglesAlone) {
  const Point p{0.1, 0.7};
  for (int i = 0; i < 1000; ++i) {
    const double turn = 0.00628 * i;
    const Point u{std::cos(turn), std::sin(turn)}, across{-u.y, u.x};
    EXPECT_TRUE(surely_acute(p + u, p, p + across + 1e-9 * u)) << i;
    EXPECT_FALSE(surely_acute(p + u, p, p + across - 1e-9 * u)) << i;
  }
}

TEST(BluntCorners, RightAnglesAlongAxes) {
  EXPECT_TRUE(is_right_along_axes({3, 2}, {1, 2}, {1, 5}));
  EXPECT_TRUE(is_right_along_axes({1, 5}, {1, 2}, {3, 2}));
  EXPECT_FALSE(is_right_along_axes({3, 2}, {1, 2}, {1.5, 5}));
  EXPECT_FALSE(is_right_along_axes({2, 3}, {1, 2}, {0, 3}));
}

}  // namespace
}  // namespace quadloop
