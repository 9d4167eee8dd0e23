#include "mesher/geometry/nearest_on_segment.hpp"

#include <gtest/gtest.h>

#include <random>

namespace quadloop {
namespace {

TEST(NearestOnSegment, EndsMiddleAndNoLength) {
  const Point a{0, 0}, b{2, 0};
  EXPECT_EQ(nearest_on_segment({-3, 4}, a, b), a);
  EXPECT_EQ(nearest_on_segment({5, 4}, a, b), b);
  EXPECT_EQ(nearest_on_segment({0.5, 4}, a, b), (Point{0.5, 0}));
  EXPECT_EQ(nearest_on_segment({3, 4}, a, a), a);
  EXPECT_EQ(distance_to_segment({-3, 4}, a, b), 5);
  EXPECT_EQ(distance_to_segment({5, 4}, a, b), 5);
  EXPECT_EQ(distance_to_segment({0.5, 4}, a, b), 4);
  EXPECT_EQ(distance_to_segment({3, 4}, a, a), 5);
}

TEST(NearestOnSegment, PlaceAtEndsAndMiddle) {
  const Point a{0, 0}, b{2, 0};
  EXPECT_EQ(place_on_segment({-3, 4}, a, b).squared_distance, 25);
  EXPECT_EQ(place_on_segment({-3, 4}, a, b).parameter, 0);
  EXPECT_EQ(place_on_segment({5, 4}, a, b).parameter, 1);
  EXPECT_EQ(place_on_segment({5, 4}, a, b).squared_distance, 25);
  EXPECT_EQ(place_on_segment({0.5, 4}, a, b).parameter, 0.25);
  EXPECT_EQ(place_on_segment({3, 4}, a, a).squared_distance, 25);
}

TEST(NearestOnSegment, TurnedRoundAndMirroredTheSame) {
  std::mt19937_64 random(3);
  const auto number = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto mirrored = [](Point p) { return Point{p.y, -p.x}; };
  for (int i = 0; i < 2000; ++i) {
    const Point a{number(), number()}, b{number(), number()}, p{number(), number()};
    const Point nearest = nearest_on_segment(p, a, b);
    EXPECT_EQ(nearest_on_segment(p, b, a), nearest);
    EXPECT_EQ(nearest_on_segment(mirrored(p), mirrored(a), mirrored(b)), mirrored(nearest));
    const double distance = distance_to_segment(p, a, b);
    EXPECT_EQ(distance_to_segment(p, b, a), distance);
    EXPECT_EQ(distance_to_segment(mirrored(p), mirrored(a), mirrored(b)), distance);
    EXPECT_NEAR(distance, length(nearest - p), 1e-15);
    EXPECT_NEAR(distance, std::sqrt(place_on_segment(p, a, b).squared_distance), 1e-15);
  }
}

TEST(NearestOnSegment, DistanceIsTrueCloseToTheSegment) {
  const Point a{1e6, 1e6}, b{1e6 + 3, 1e6 + 4};
  const double step = std::nextafter(1e6, 2e6) - 1e6;
  EXPECT_NEAR(distance_to_segment({1e6 + 1.5, 1e6 + 2 + step}, a, b) / step, 0.6, 1e-9);
}

}  // namespace
}  // namespace quadloop
