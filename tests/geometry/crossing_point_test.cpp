#include "mesher/geometry/crossing_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop {
namespace {

TEST(CrossingPoint, IsTheExactOneWhereThatIsADouble) {
  EXPECT_EQ(crossing_point({0, 0}, {2, 2}, {0, 2}, {2, 0}), (Point{1, 1}));
  EXPECT_EQ(crossing_point({-1, 0.25}, {3, 0.25}, {0.1, -7}, {0.1, 9}), (Point{0.1, 0.25}));
  EXPECT_EQ(crossing_point({-1, 0}, {1, 0}, {0, -1}, {0, 1}), (Point{0, 0}));
}

TEST(CrossingPoint, IsRoundedToTheNearest) {
  // The diagonal of a unit square at a third.
  EXPECT_EQ(crossing_point({0, 0}, {1, 1}, {0, 0.5}, {1, 0}), (Point{1.0 / 3, 1.0 / 3}));
  EXPECT_EQ(crossing_point({0, 0}, {3, 7}, {0, 1}, {7, 0}), (Point{21.0 / 52, 49.0 / 52}));
}

TEST(CrossingPoint, DoesNotDependOnTheOrder) {
  const Point a{0.1, 0.7}, b{13.3, 5.9}, c{1e-3, 6.1}, d{9.7, -2.3};
  const Point p = crossing_point(a, b, c, d);
  EXPECT_EQ(crossing_point(b, a, c, d), p);
  EXPECT_EQ(crossing_point(c, d, a, b), p);
  EXPECT_EQ(crossing_point(d, c, b, a), p);
  const auto mirrored = [](Point q) { return Point{q.x, -q.y}; };
  EXPECT_EQ(crossing_point(mirrored(a), mirrored(b), mirrored(c), mirrored(d)), mirrored(p));
}

TEST(CrossingPoint, HoldsForNearlyParallelLinesFarAway) {
  const double e = std::ldexp(1.0, -50);
  EXPECT_EQ(crossing_point({0, 0}, {1e9, 0}, {5e8, -e}, {5e8, e}), (Point{5e8, 0}));
  EXPECT_EQ(crossing_point({0, 0}, {4, e}, {0, e}, {4, 0}), (Point{2, e / 2}));
}

}  // namespace
}  // namespace quadloop
