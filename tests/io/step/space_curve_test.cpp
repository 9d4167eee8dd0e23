#include "io/step/space_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace quadloop::io {
namespace {

/// A cubic with a double and two single inner knots; rational with weights.
SpaceSpline sample(bool rational) {
  SpaceSpline spline{3,
                     {0, 0, 0, 0, 1, 2, 2, 3.5, 5, 5, 5, 5},
                     {{{0, 0, 1}},
                      {{1, 2, 0}},
                      {{3, 3, -1}},
                      {{4, 0, 2}},
                      {{6, -1, 1}},
                      {{7, 2, 0}},
                      {{9, 2, 1}},
                      {{9, 4, 3}}},
                     {}};
  if (rational) spline.weights = {1, 2, 0.5, 1, 3, 1, 0.7, 1};
  return spline;
}

/// A uniform cubic, whose range is 0 to 5: no knot is repeated.
SpaceSpline uniform() {
  SpaceSpline spline = sample(false);
  spline.knots.clear();
  for (int i = -3; i <= 8; ++i) spline.knots.push_back(i);
  return spline;
}

TEST(SpaceSpline, PartsAreOnTheCurve) {
  for (const SpaceSpline& spline : {sample(false), sample(true), uniform()}) {
    for (const auto& [from, to] :
         {std::pair(0.0, 5.0), {0.3, 4.9}, {1.0, 2.0}, {2.0, 3.5}, {1.2, 1.3}, {0.0, 2.7}, {3.6, 5.0}}) {
      const SpaceSpline part = part_of(spline, from, to);
      EXPECT_EQ(fault_of(part), "");
      EXPECT_EQ(part.begin(), from);
      EXPECT_EQ(part.end(), to);
      for (int i = 0; i <= 50; ++i) {
        const double t = from + (to - from) * i / 50;
        EXPECT_LT(length(part.point_at(t) - spline.point_at(t)), 1e-13)
            << from << " to " << to << " at " << t;
      }
    }
  }
}

TEST(SpaceSpline, FindsParametersOfItsPoints) {
  for (const SpaceSpline& spline : {sample(false), sample(true), uniform(), polyline(sample(false).poles)}) {
    for (int i = 0; i <= 100; ++i) {
      const double t = spline.begin() + (spline.end() - spline.begin()) * i / 100;
      EXPECT_NEAR(nearest_parameter(spline, spline.point_at(t)), t, 1e-12);
    }
  }
}

TEST(SpaceSpline, FindsTheParameterOnALongSegmentOfAPolyline) {
  // The path passes near p with a vertex before it goes through p.
  const SpaceSpline path = polyline({{{5, 1, 0}}, {{0, 0, 0}}, {{10, 0, 0}}, {{5.5, 1, 0}}});
  EXPECT_NEAR(nearest_parameter(path, {{5, 0, 0}}), 1.5, 1e-12);
}

TEST(SpaceSpline, NamesItsFaults) {
  SpaceSpline broken = sample(false);
  broken.knots = {0, 0, 0, 0, 2, 2, 2, 2, 5, 5, 5, 5};
  EXPECT_NE(fault_of(broken).find("multiplicity above the degree"), std::string::npos);
  broken.knots = {0, 0, 0, 0, 2, 2, 2, 3, 5, 5, 5, 5};
  EXPECT_EQ(fault_of(broken), "");
  broken.poles[2].at[2] = std::nan("");
  EXPECT_NE(fault_of(broken).find("not finite"), std::string::npos);
  broken = sample(true);
  broken.weights[1] = 0;
  EXPECT_NE(fault_of(broken).find("not positive"), std::string::npos);
}

TEST(SpaceArc, FindsParameters) {
  const SpaceArc arc{{{1, 2, 3}}, {{3, 0, 0}}, {{0, 0, -2}}, 0, 1};
  for (int i = -9; i <= 9; ++i) EXPECT_NEAR(arc.parameter_of(arc.point_at(i * 0.3)), i * 0.3, 1e-15);
}

TEST(SpaceCurve, SamplesOfAnArcShowItsPlane) {
  const SpaceArc arc{{{0, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, 0, std::numbers::pi};
  for (const SpacePoint& p : sample_of({arc, {}, {}})) EXPECT_EQ(p.at[0], 0);
  EXPECT_EQ(sample_of({arc, {}, {}}).size(), 5u);
}

}  // namespace
}  // namespace quadloop::io
