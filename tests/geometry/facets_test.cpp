#include "mesher/geometry/facets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadloop {
namespace {

/// A regular polygon of radius 1.
Geometry polygon(int corners) {
  std::vector<Point> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return Geometry({{"wall", 0, 30, "wall"}}, std::move(points), {0, corners},
                  std::vector<BoundaryId>(corners, BoundaryId{0}));
}

TEST(Facets, ArePointsThatTurnVisiblyAndAreNoCorners) {
  const auto facets = facets_of(polygon(30));  // 12 degrees
  ASSERT_EQ(facets.size(), 30u);
  EXPECT_NEAR(facets[0].turn_degrees, 12, 1e-9);
  EXPECT_NEAR(facets[0].segment, 2 * std::sin(std::numbers::pi / 30), 1e-12);
  EXPECT_TRUE(facets_of(polygon(180)).empty()) << "2 degrees are smooth";
  EXPECT_TRUE(facets_of(polygon(8)).empty()) << "45 degrees are corners";
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
