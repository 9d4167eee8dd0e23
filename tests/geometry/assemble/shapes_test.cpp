// Outlines without a file: how far they are from the curves that they stand for.
#include "mesher/geometry/assemble/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/naca_section.hpp"
#include "mesher/geometry/assemble/transform.hpp"

namespace quadloop {
namespace {

NacaAirfoil airfoil_of(const std::string& code, bool sharp = true, double flap = 0) {
  NacaAirfoil airfoil;
  airfoil.code = code;
  airfoil.sharp = sharp;
  airfoil.flap_degrees = flap;
  return airfoil;
}

CurvedSegment segment_of(const Chain& chain, std::size_t s) {
  return {chain.points[s], chain.curves[s], chain.points[(s + 1) % chain.points.size()]};
}

/// The distance of a point from a surface of the section, along the y-axis.
double height_above(const NacaSection& section, int side, Point p) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (section.point_at(middle, side).x < p.x ? low : high) = middle;
  }
  return std::abs(section.point_at(low, side).y - p.y);
}

TEST(Shapes, ACircleIsExact) {
  const Chain chain = circle("hole", {3, -2}, 0.7, "here");
  EXPECT_FALSE(chain.open);
  EXPECT_EQ(chain.points.size(), 4U);
  for (std::size_t s = 0; s < chain.points.size(); ++s) {
    for (const double t : {0.0, 0.2, 0.5, 0.9})
      EXPECT_NEAR(length(point_at(segment_of(chain, s), t) - Point{3, -2}), 0.7, 1e-15);
  }
}

TEST(Shapes, ARectangleAndAPolygonAreStraight) {
  const Chain box = rectangle("box", {{1, 2}, {4, 3}}, "here");
  EXPECT_EQ(box.points, (std::vector<Point>{{1, 2}, {4, 2}, {4, 3}, {1, 3}}));
  EXPECT_TRUE(box.curves.empty());
  const Chain kite = polygon("kite", {{0, 0}, {1, 0}, {0, 1}}, "here");
  EXPECT_EQ(kite.points.size(), 3U);
  EXPECT_FALSE(kite.directed) << "points may run either way";
}

TEST(Shapes, AnAirfoilFollowsItsFormula) {
  for (const char* code : {"0012", "2412", "4415", "23012", "23112", "0012-64"}) {
    const Chain chain = naca_chain("wing", airfoil_of(code), "here");
    const NacaSection section(code, true);
    EXPECT_EQ(chain.points.front(), (Point{1, section.camber_height(1)}));
    ASSERT_EQ(chain.curves.size(), chain.points.size());
    const auto nose = std::ranges::min_element(chain.points, {}, [](Point p) { return length(p); });
    const std::size_t nose_at = nose - chain.points.begin();
    double away = 0;
    for (std::size_t s = 0; s < chain.points.size(); ++s) {
      const Point p = point_at(segment_of(chain, s), 0.5);
      if (p.x > 0.005) away = std::max(away, height_above(section, s < nose_at ? -1 : 1, p));
    }
    EXPECT_LT(away, 2e-8) << code;
  }
}

TEST(Shapes, ABluntAirfoilHasAStraightBase) {
  const Chain chain = naca_chain("wing", airfoil_of("2412", false), "here");
  EXPECT_TRUE(chain.curves.back().straight());
  EXPECT_NEAR(length(chain.points.back() - chain.points.front()), 0.00252, 1e-5);
  EXPECT_EQ(std::ranges::count_if(chain.curves, [](const Curve& c) { return c.straight(); }), 1);
}

/// The corners of an outline, without the trailing edge.
std::vector<Point> corners_of_flap(const NacaAirfoil& airfoil) {
  std::vector<Point> corners;
  const Chain chain = naca_chain("wing", airfoil, "here");
  for (std::size_t s = 1; s < chain.points.size(); ++s) {
    const Point in = direction_at_end(segment_of(chain, s - 1)),
                out = direction_at_start(segment_of(chain, s));
    if (std::abs(std::atan2(cross(in, out), dot(in, out))) > 0.02) corners.push_back(chain.points[s]);
  }
  return corners;
}

TEST(Shapes, AFlapHasOneCornerOnTheInnerSideOfTheBend) {
  for (const char* code : {"0012", "2412", "23012"}) {
    for (const double flap : {1.5, 10.0, 40.0, -5.0, -30.0}) {
      const std::vector<Point> corners = corners_of_flap(airfoil_of(code, true, flap));
      ASSERT_EQ(corners.size(), 1U) << code << " " << flap;
      EXPECT_LT(corners[0].y * flap, 0) << "below, if the flap moves down";
      EXPECT_NEAR(corners[0].x, 0.75, 0.05);
    }
  }
}

TEST(Shapes, AFlapTurnsAboutItsHinge) {
  NacaAirfoil airfoil = airfoil_of("0012", true, 20);
  airfoil.hinge = {0.7, 0.01};
  const Point hinge{0.7, 0.01};
  const std::vector<std::vector<Point>> parts = smooth_parts(airfoil);
  ASSERT_EQ(parts.size(), 4U) << "flap below, fixed part, arc, flap above";
  EXPECT_EQ(parts.front().front(), turned_about(hinge, {1, 0}, unit_vector(-20)));
  EXPECT_EQ(parts.back().back(), parts.front().front());
  for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_EQ(parts[i].front(), parts[i - 1].back());
  const NacaSection section("0012", true);
  const std::vector<Point>& arc = parts[2];
  for (const Point p : arc) EXPECT_NEAR(length(p - hinge), length(arc.front() - hinge), 1e-15);
  const Point tangent = arc[1] - arc[0], before = parts[1].back() - parts[1][parts[1].size() - 2];
  EXPECT_NEAR(std::atan2(cross(before, tangent), dot(before, tangent)), 0, 0.03) << "no corner";
  // The corner is a point of the fixed surface and, turned back, one of the flap's.
  const Point corner = parts[1].front(), back = turned_about(hinge, corner, unit_vector(20));
  EXPECT_LT(height_above(section, -1, corner), 1e-12);
  EXPECT_LT(height_above(section, -1, back), 1e-12);
}

TEST(Shapes, AFlapDownIsTheMirrorImageOfAFlapUp) {
  const Chain down = naca_chain("wing", airfoil_of("0012", true, 12), "here"),
              up = naca_chain("wing", airfoil_of("0012", true, -12), "here");
  ASSERT_EQ(down.points.size(), up.points.size());
  const std::size_t n = up.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point image{up.points[(n - i) % n].x, -up.points[(n - i) % n].y};
    EXPECT_LT(length(down.points[i] - image), 1e-14);
  }
}

TEST(Shapes, ImpossibleFlapsAreRefused) {
  const auto refused = [](double flap, std::vector<double> hinge, const char* code = "2412") {
    NacaAirfoil airfoil = airfoil_of(code, true, flap);
    airfoil.hinge = std::move(hinge);
    try {
      (void)smooth_parts(airfoil);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(10, {0.7, 0.3}).find("the hinge at (0.7, 0.3) is not inside '2412'"), std::string::npos);
  EXPECT_NE(refused(10, {0.7, -0.3}).find("not inside"), std::string::npos);
  EXPECT_NE(refused(10, {1.5}).find("not inside"), std::string::npos);
  EXPECT_NE(refused(10, {-0.5}).find("not inside"), std::string::npos);
  EXPECT_NE(refused(60, {0.95, 0.03}, "0060")
                .find("'0060' cannot turn by 60 degrees about (0.95, 0.03); give a smaller angle"),
            std::string::npos);
  EXPECT_EQ(refused(30, {0.97}), "");
  EXPECT_EQ(refused(0, {0.7, 0.3}), "") << "no flap, no hinge";
}

TEST(Shapes, AirfoilsWithFlapsAreSimpleLoops) {
  for (const double flap : {-60.0, -20.0, 1.0, 35.0, 60.0}) {
    for (const bool sharp : {true, false}) {
      std::vector<Chain> chains{naca_chain("wing", airfoil_of("4415", sharp, flap), "here"),
                                rectangle("box", {{-3, -3}, {4, 3}}, "here")};
      Warnings warnings;
      const Geometry geometry = assemble(chains, {}, warnings);
      EXPECT_EQ(geometry.loop_count(), 2);
      EXPECT_TRUE(warnings.empty()) << warnings.front();
    }
  }
}

}  // namespace
}  // namespace quadloop
