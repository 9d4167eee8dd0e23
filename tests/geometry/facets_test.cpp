#include "mesher/geometry/facets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadloop {
namespace {

/// A regular polygon of radius 1 with points on its sides, which are rounded to 1e-6.
Geometry polygon(int corners, int points_on_side = 0) {
  std::vector<Point> points;
  const auto corner = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    return Point{std::cos(angle), std::sin(angle)};
  };
  for (int k = 0; k < corners; ++k) {
    points.push_back(corner(k));
    for (int i = 1; i <= points_on_side; ++i) {
      const Point p = corner(k) + static_cast<double>(i) / (points_on_side + 1) * (corner(k + 1) - corner(k));
      points.push_back({std::round(1e6 * p.x) / 1e6, std::round(1e6 * p.y) / 1e6});
    }
  }
  const int size = static_cast<int>(points.size());
  return Geometry({{"wall", 0, 30, "wall"}}, std::move(points), {0, size},
                  std::vector<BoundaryId>(size, BoundaryId{0}));
}

TEST(Facets, ArePointsThatTurnVisiblyAndAreNoCorners) {
  const auto facets = facets_of(polygon(30));  // 12 degrees
  ASSERT_EQ(facets.size(), 30u);
  EXPECT_NEAR(facets[0].turn_degrees, 12, 1e-9);
  EXPECT_NEAR(facets[0].segment, 2 * std::sin(std::numbers::pi / 30), 1e-12);
  EXPECT_TRUE(facets_of(polygon(180)).empty()) << "2 degrees are smooth";
  EXPECT_TRUE(facets_of(polygon(8)).empty()) << "45 degrees are corners";
}

TEST(Facets, PointsOnStraightSidesDoNotCount) {
  for (const int points_on_side : {1, 4}) {
    const auto facets = facets_of(polygon(30, points_on_side));
    ASSERT_EQ(facets.size(), 30u) << points_on_side;
    EXPECT_NEAR(facets[1].turn_degrees, 12, 1e-2);
    EXPECT_NEAR(facets[1].segment, 2 * std::sin(std::numbers::pi / 30), 1e-5);
    EXPECT_EQ(facets[1].vertex, points_on_side + 1);
    EXPECT_TRUE(facets_of(polygon(200, points_on_side)).empty()) << "1.8 degrees are smooth";
    EXPECT_TRUE(facets_of(polygon(8, points_on_side)).empty()) << "45 degrees are corners";
  }
}

TEST(Facets, ASmoothCurveBetweenTwoKinksIsNoSide) {
  std::vector<Point> points;  // half circles of 1 degree a point, joined with kinks of 4 degrees
  for (int k = 0; k <= 180; ++k) {
    const double angle = std::numbers::pi / 180 * (-88 + 176.0 * k / 180);
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  for (int k = 1; k < 180; ++k) points.push_back({2 * points[0].x - points[180 - k].x, points[180 - k].y});
  const int size = static_cast<int>(points.size());
  const Geometry lens({{"wall", 0, 30, "wall"}}, std::move(points), {0, size},
                      std::vector<BoundaryId>(size, BoundaryId{0}));
  EXPECT_GT(lens.bend_degrees(180), 4);
  EXPECT_TRUE(facets_of(lens).empty());
}

TEST(Facets, ZonesReachHalfASegment) {
  const FacetZones zones(polygon(30));
  const double half = std::sin(std::numbers::pi / 30);
  const auto at = [](Point p) { return Box{p, p}; };
  EXPECT_NEAR(zones.least_size(at({1, 0})), half, 1e-12);
  EXPECT_NEAR(zones.least_size(at({1 + 0.99 * half, 0})), half, 1e-12);
  EXPECT_EQ(zones.least_size(at({1 + 1.01 * half, 0})), 0);
  EXPECT_EQ(zones.least_size(at({0, 0})), 0);
  EXPECT_NEAR(zones.least_size({{0, 0}, {2, 2}}), half, 1e-12);
  EXPECT_TRUE(FacetZones(polygon(8)).empty());
}

}  // namespace
}  // namespace quadloop
