// The region within an outline, for boxes inside, outside and across it.
#include "mesher/geometry/outline_region.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

using Edges = std::vector<std::pair<Point, Point>>;

Edges square_edges(double low, double high) {
  return {{{low, low}, {high, low}},
          {{high, low}, {high, high}},
          {{high, high}, {low, high}},
          {{low, high}, {low, low}}};
}

TEST(OutlineRegion, MeetsBoxesInsideAcrossAndAround) {
  const OutlineRegion square(square_edges(0, 4));
  EXPECT_TRUE(square.meets({{1, 1}, {2, 2}}));
  EXPECT_TRUE(square.meets({{3, 3}, {6, 6}}));
  EXPECT_TRUE(square.meets({{-1, -1}, {6, 6}}));
  EXPECT_TRUE(square.meets({{4, 1}, {5, 2}})) << "a common side";
  EXPECT_FALSE(square.meets({{4.1, 1}, {5, 2}}));
  EXPECT_FALSE(square.meets({{-3, 1}, {-1, 2}}));
}

TEST(OutlineRegion, HasHolesAndIgnoresEdgesThatPassItsBox) {
  Edges edges = square_edges(0, 4);
  for (const auto& edge : square_edges(1, 3)) edges.push_back(edge);
  const OutlineRegion ring(edges);
  EXPECT_FALSE(ring.meets({{1.5, 1.5}, {2.5, 2.5}}));
  EXPECT_TRUE(ring.meets({{0.2, 0.2}, {0.8, 0.8}}));
  EXPECT_TRUE(ring.meets({{1.5, 1.5}, {3.5, 2.5}}));
  const OutlineRegion triangle({{{0, 0}, {4, 0}}, {{4, 0}, {0, 4}}, {{0, 4}, {0, 0}}});
  EXPECT_FALSE(triangle.meets({{2.5, 2.5}, {3, 3}})) << "within the box of the long edge";
  EXPECT_TRUE(triangle.meets({{1.5, 1.5}, {3, 3}}));
}

}  // namespace
}  // namespace quadloop
