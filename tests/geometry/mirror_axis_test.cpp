// Images of points in an axis, to the last bit.
#include "mesher/geometry/mirror_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop {
namespace {

TEST(MirrorAxis, OneCoordinateChangesItsSign) {
  EXPECT_EQ(image_of(MirrorAxis::x, {0.1, 0.3}), (Point{0.1, -0.3}));
  EXPECT_EQ(image_of(MirrorAxis::y, {0.1, 0.3}), (Point{-0.1, 0.3}));
  EXPECT_FALSE(std::signbit(image_of(MirrorAxis::x, {1, 0}).y));
  EXPECT_FALSE(std::signbit(image_of(MirrorAxis::y, {0, 1}).x));
}

TEST(MirrorAxis, SidesAreToldByIt) {
  EXPECT_EQ(side_of(MirrorAxis::x, {-1, 1e-300}), 1);
  EXPECT_EQ(side_of(MirrorAxis::x, {-1, 0}), 0);
  EXPECT_EQ(side_of(MirrorAxis::y, {-1, 2}), -1);
}

}  // namespace
}  // namespace quadloop
