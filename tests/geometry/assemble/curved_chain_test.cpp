// Arcs, B-splines and interpolating splines as segments of chains.
#include "mesher/geometry/assemble/curved_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace quadloop {
namespace {

constexpr double pi = std::numbers::pi;

CurvedSegment segment(const Chain& chain, std::size_t s) {
  return {chain.points[s], chain.curves[s], chain.points[(s + 1) % chain.points.size()]};
}

/// Calls `check(point)` for points of all segments; returns their number.
int for_each_point(const Chain& chain, const auto& check) {
  int count = 0;
  for (std::size_t s = 0; s < chain.curves.size(); ++s) {
    for (int i = 0; i <= 20; ++i, ++count) check(point_at(segment(chain, s), i / 20.0));
  }
  return count;
}

Chain from(Point p) { return {"curve", true, {p}, "here"}; }

TEST(CurvedChain, ArcsOfEllipsesAreExact) {
  const EllipticArc arc{{1, 2}, {3, 1}, {-0.4, 1.2}, 0.3, 0.3 + 1.9 * pi};
  Chain chain = from(arc.point_at(arc.begin));
  append_arc(chain, arc);
  EXPECT_EQ(chain.curves.size(), 4U);
  const double determinant = cross(arc.major, arc.minor);
  const int count = for_each_point(chain, [&](Point p) {
    const Point d = p - arc.centre;
    const double u = cross(d, arc.minor) / determinant, v = cross(arc.major, d) / determinant;
    EXPECT_NEAR(u * u + v * v, 1, 1e-14);
  });
  EXPECT_EQ(count, 84);
  EXPECT_LT(length(chain.points.back() - arc.point_at(arc.end)), 1e-15);
}

TEST(CurvedChain, BulgesAreCircularArcs) {
  for (const double degrees : {10.0, 90.0, 180.0, 270.0, 340.0, -60.0, -200.0}) {
    const double angle = degrees * pi / 180;
    Chain chain = from({1, 1});
    append_bulge(chain, std::tan(angle / 4), {3, 2});
    // The centre is left of the chord for counter-clockwise arcs of less than a half circle.
    const Point chord = Point{2, 1}, left{-chord.y, chord.x};
    const Point centre = Point{2, 1.5} + (0.5 / std::tan(angle / 2)) * left;
    const double radius = length(Point{1, 1} - centre);
    for_each_point(chain,
                   [&](Point p) { EXPECT_NEAR(length(p - centre), radius, 1e-14 * radius) << degrees; });
    double turned = 0;
    for (std::size_t s = 0; s < chain.curves.size(); ++s) {
      const Point a = direction_at_start(segment(chain, s)), b = direction_at_end(segment(chain, s));
      turned += std::atan2(cross(a, b), dot(a, b));
    }
    EXPECT_NEAR(turned, angle, 1e-13);
  }
}

TEST(CurvedChain, ABulgeOfZeroIsALine) {
  Chain chain = from({0, 0});
  append_bulge(chain, 0, {1, 0});
  EXPECT_TRUE(chain.curves.empty());
}

/// De Boor's algorithm for one point, as an independent evaluation.
Point de_boor(const BSpline& s, double t) {
  std::size_t k = s.degree;
  while (k + 1 < s.poles.size() && s.knots[k + 1] <= t) ++k;
  struct Row {
    double x, y, w;
  };
  std::vector<Row> d;
  for (std::size_t i = k - s.degree; i <= k; ++i) {
    const double w = s.weights.empty() ? 1 : s.weights[i];
    d.push_back({w * s.poles[i].x, w * s.poles[i].y, w});
  }
  for (int r = 1; r <= s.degree; ++r) {
    for (int j = s.degree; j >= r; --j) {
      const std::size_t i = j + k - s.degree;
      const double a = (t - s.knots[i]) / (s.knots[i + s.degree - r + 1] - s.knots[i]);
      d[j] = {(1 - a) * d[j - 1].x + a * d[j].x, (1 - a) * d[j - 1].y + a * d[j].y,
              (1 - a) * d[j - 1].w + a * d[j].w};
    }
  }
  return {d[s.degree].x / d[s.degree].w, d[s.degree].y / d[s.degree].w};
}

TEST(CurvedChain, BSplinesAreExact) {
  BSpline spline{3, {0, 0, 0, 0, 0.4, 0.5, 0.5, 0.5, 0.9, 1, 1, 1, 1}, {}, {}};
  for (int i = 0; i < 9; ++i) spline.poles.push_back({double(i), std::sin(1.3 * i)});
  for (const bool rational : {false, true}) {
    if (rational) spline.weights = {1, 0.5, 2, 1, 3, 1, 0.7, 1, 1};
    ASSERT_EQ(fault_of(spline), "");
    Chain chain = from(start_of(spline));
    append_bspline(chain, spline);
    const std::vector<double> knots{0, 0.4, 0.5, 0.9, 1};
    ASSERT_EQ(chain.curves.size(), 4U);
    for (std::size_t s = 0; s < 4; ++s) {
      for (int i = 0; i < 10; ++i) {
        const double u = i / 10.0, t = knots[s] + u * (knots[s + 1] - knots[s]);
        EXPECT_LT(length(point_at(segment(chain, s), u) - de_boor(spline, t)), 1e-13);
      }
    }
    EXPECT_EQ(chain.points.back(), (Point{8, std::sin(1.3 * 8)}));
  }
}

TEST(CurvedChain, FaultyBSplinesAreNamed) {
  const BSpline good{2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {1, 1}, {2, 0}}, {}};
  EXPECT_EQ(fault_of(good), "");
  const auto with = [&](auto change) {
    BSpline spline = good;
    change(spline);
    return fault_of(spline);
  };
  EXPECT_NE(with([](BSpline& s) { s.degree = 16; }), "");
  EXPECT_NE(with([](BSpline& s) { s.poles.pop_back(); }), "");
  EXPECT_NE(with([](BSpline& s) { s.knots.pop_back(); }), "");
  EXPECT_NE(with([](BSpline& s) { s.knots[3] = -1; }), "");
  EXPECT_NE(with([](BSpline& s) { s.weights = {1, 0, 1}; }), "");
  EXPECT_NE(with([](BSpline& s) { s.poles[1].x = std::nan(""); }), "");
  EXPECT_NE(with([](BSpline& s) { s.knots = {0, 0, 0, 0, 0, 0}; }), "");
}

TEST(CurvedChain, SplinesReproduceCubics) {
  const auto cubic = [](double x) { return Point{x, 0.3 * x * x - 0.1 * x * x * x}; };
  // In the chord length a nearly straight cubic is a cubic up to the square of its slope.
  constexpr double flat = 1e-4;
  Chain chain = from({0, 0});
  std::vector<Point> points;
  for (const double x : {0.3, 0.7, 1.4, 1.8, 2.5}) points.push_back({x, flat * cubic(x).y});
  append_spline(chain, points);
  for_each_point(chain, [&](Point p) { EXPECT_NEAR(p.y, flat * cubic(p.x).y, 1e-8 * flat); });
}

TEST(CurvedChain, SplinesConvergeToACircleAndAreSmooth) {
  double before = 0;
  for (const int n : {16, 32, 64}) {
    Chain circle{"circle", false, {}, "here"};
    for (int i = 0; i < n; ++i) circle.points.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)});
    join_by_splines(circle, 30);
    ASSERT_EQ(circle.curves.size(), circle.points.size());
    double error = 0;
    for_each_point(circle, [&](Point p) { error = std::max(error, std::abs(length(p) - 1)); });
    if (before > 0) {
      EXPECT_LT(error, before / 12);  // fourth order
    }
    before = error;
    for (int i = 0; i < n; ++i) {
      const Point in = direction_at_end(segment(circle, i)),
                  out = direction_at_start(segment(circle, (i + 1) % n));
      EXPECT_LT(std::abs(cross(in, out)), 1e-13);
    }
  }
}

TEST(CurvedChain, ReversedPointsHaveTheReversedSpline) {
  Chain chain{"c", true, {{0, 0}, {1, 0.2}, {1.7, 0.1}, {3, 0.6}, {3.4, 1.1}}, "here"}, back = chain;
  std::ranges::reverse(back.points);
  join_by_splines(chain, 30);
  join_by_splines(back, 30);
  EXPECT_EQ(reversed(back.curves), chain.curves);
}

TEST(CurvedChain, SplinesKeepCorners) {
  // A coarse airfoil: its nose turns by 49 degrees, but the next points by 32; its tail is a corner.
  Chain airfoil{"airfoil", false, {}, "here"};
  constexpr int n = 20;
  for (int i = 0; i < 2 * n; ++i) {
    const double t = pi * i / n, x = 0.5 * (1 + std::cos(t));
    const double y = 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                            0.1036 * x * x * x * x);
    airfoil.points.push_back({x, i <= n ? -y : y});
  }
  join_by_splines(airfoil, 30);
  int corners = 0;
  for (std::size_t s = 0; s < airfoil.curves.size(); ++s) {
    const Point in = direction_at_end(segment(airfoil, s)),
                out = direction_at_start(segment(airfoil, (s + 1) % airfoil.curves.size()));
    if (dot(in, out) < std::cos(1 * pi / 180)) ++corners;
  }
  EXPECT_EQ(corners, 1);
}

TEST(CurvedChain, RepeatedPointsAreDroppedWithTheirSegments) {
  Chain chain = from({0, 0});
  append_line(chain, {1, 0});
  append_line(chain, {1, 0});
  append_bulge(chain, 0.2, {2, 0});
  append_line(chain, {3, 0});
  const auto [count, first] = drop_repeats(chain, 0);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(first, (Point{1, 0}));
  ASSERT_EQ(chain.curves.size(), 3U);
  EXPECT_TRUE(chain.curves[0].straight());
  EXPECT_FALSE(chain.curves[1].straight());
  EXPECT_TRUE(chain.curves[2].straight());
  EXPECT_EQ(chain.points, (std::vector<Point>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
}

TEST(CurvedChain, TheClosingSegmentKeepsItsCurve) {
  Chain chain{"c", false, {{0, 0}, {1, 0}, {1, 1}, {0, 0}}, "here"};
  chain.curves = {{}, {}, Curve{{{0.4, 0.7}}, {}, 0}, {}};
  drop_repeats(chain, 0);
  ASSERT_EQ(chain.points.size(), 3U);
  ASSERT_EQ(chain.curves.size(), 3U);
  EXPECT_FALSE(chain.curves[2].straight());
}

TEST(CurvedChain, TheBoxHoldsTheCurvesAndNoMore) {
  Chain arc{"arc", true, {{std::cos(0.2), std::sin(0.2)}}, "file"};
  append_arc(arc, {{0, 0}, {1, 0}, {0, 1}, 0.2, 4});
  const Box box = box_of(std::vector{arc, Chain{"line", true, {{0, 0}, {0.5, 3}}, "file"}});
  EXPECT_NEAR(box.low.x, -1, 1e-15);
  EXPECT_EQ(box.high.x, std::cos(0.2));
  EXPECT_NEAR(box.low.y, std::sin(4), 1e-15);
  EXPECT_EQ(box.high.y, 3);
  EXPECT_NEAR(box_of(std::vector{arc}).high.y, 1, 1e-15);
  arc.curves[0].inner[0].x = std::numeric_limits<double>::quiet_NaN();
  box_of(std::vector{arc});  // in no time
}

}  // namespace
}  // namespace quadloop
