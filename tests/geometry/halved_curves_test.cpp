// Halved curves keep their shape, and the demands of the geometry.
#include "mesher/geometry/halved_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace quadloop {
namespace {

/// A half disc: a straight side and two quarter circles.
Geometry half_disc() {
  const double weight = std::sqrt(0.5);
  const Curve right{{{1, 1}}, {1, weight, 1}, 0.3}, left{{{-1, 1}}, {1, weight, 1}, 0.4};
  return {{{"rim"}, {"side"}},
          {{-1, 0}, {1, 0}, {0, 1}},
          {0, 3},
          {BoundaryId{1}, BoundaryId{0}, BoundaryId{0}},
          {Curve{}, right, left}};
}

TEST(HalvedCurves, LieOnTheCurveAndMakeTheSameDemands) {
  const Geometry g = half_disc();
  const Geometry halved = with_halved_curves(g, {1, 0, 1});
  ASSERT_EQ(halved.size(), 4);  // a straight segment has no halves
  const std::vector<std::int32_t> source{0, 1, 2, 2};
  for (std::int32_t s = 0; s < halved.size(); ++s) {
    EXPECT_EQ(halved.boundary_of(s), g.boundary_of(source[s]));
    EXPECT_EQ(halved.spacing_of(s), g.spacing_of(source[s]));
    EXPECT_EQ(halved.is_curved(s), s > 0);
    if (s > 0) {
      EXPECT_NEAR(length(point_at(halved.segment(s), 0.3)), 1, 1e-15);
    }
    if (s == 3) continue;
    EXPECT_EQ(halved.point(s), g.point(s));
    EXPECT_EQ(halved.kept(s), g.kept(s));
    EXPECT_EQ(halved.bend_degrees(s), g.bend_degrees(s));
  }
  EXPECT_NEAR(length(halved.point(3)), 1, 1e-15);
  EXPECT_FALSE(halved.kept(3));
  EXPECT_EQ(halved.bend_degrees(3), 0);
  EXPECT_EQ(with_halved_curves(g, {0, 0, 0}).points().size(), 3U);
}

}  // namespace
}  // namespace quadloop
