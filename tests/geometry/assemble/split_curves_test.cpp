// Curves are split where other chains cross them, so that unions and blocks keep them.
#include "mesher/geometry/assemble/split_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop {
namespace {

constexpr double half_turn = std::numbers::pi;

Chain true_circle(const std::string& name, Point centre, double radius) {
  const EllipticArc arc{centre, {radius, 0}, {0, radius}, 0, 2 * half_turn};
  Chain chain{name, true, {arc.point_at(0)}, name};
  append_arc(chain, arc, chain.points.front());
  chain.points.pop_back();
  chain.open = false;
  return chain;
}
Chain outline_box(const std::string& name, double x0, double x1, double y0, double y1) {
  return {name, false, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, name};
}
Chain open_line(const std::string& name, std::vector<Point> points) {
  return {name, true, std::move(points), name};
}

/// The area of a block, with the parts between its chords and curves, by Simpson's rule on each curve.
double area_within_curves(const Geometry& g, std::int32_t block = 0) {
  double twice = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.block_of(s) != block) continue;
    constexpr int parts = 64;
    Point before = g.point(s);
    for (int k = 1; k <= parts; ++k) {
      const Point next = k == parts ? g.point(g.next(s)) : point_at(g.segment(s), k / double(parts));
      twice += cross(before, next);
      before = next;
    }
  }
  return twice / 2;
}

/// The area common to two circles of one radius whose centres are apart.
double lens_of(double radius, double apart) {
  const double half = apart / 2;
  return 2 * radius * radius * std::acos(half / radius) - apart * std::sqrt(radius * radius - half * half);
}

Geometry united_curves(std::vector<Chain> chains) {
  AssembleOptions options;
  options.unite_islands = true;
  Warnings warnings;
  return assemble(std::move(chains), options, warnings);
}

TEST(SplitCurves, CirclesThatCrossAreUnited) {
  const Geometry g = united_curves({outline_box("sea", -5, 5, -5, 5), true_circle("left", {-0.3, 0.1}, 1),
                                    true_circle("right", {0.7, 0.1}, 1)});
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_NEAR(area_within_curves(g), 100 - (2 * half_turn - lens_of(1, 1)), 1e-6);
  const double height = std::sqrt(0.75);
  int crossings = 0;
  for (std::int32_t v = 4; v < g.size(); ++v) {
    EXPECT_TRUE(g.is_curved(v));
    const double left = length(g.point(v) - Point{-0.3, 0.1}), right = length(g.point(v) - Point{0.7, 0.1});
    EXPECT_NEAR(std::min(std::abs(left - 1), std::abs(right - 1)), 0, 1e-14);
    if (std::abs(g.point(v).x - 0.2) > 1e-9) continue;
    ++crossings;
    EXPECT_NEAR(std::abs(g.point(v).y - 0.1), height, 1e-12);
    EXPECT_TRUE(g.kept(v));
  }
  EXPECT_EQ(crossings, 2);
}

TEST(SplitCurves, ACircleAndAPolygonAreUnited) {
  const Geometry g = united_curves({outline_box("sea", -5, 5, -5, 5), true_circle("body", {0, 0}, 1),
                                    outline_box("mast", -0.5, 0.5, 0.5, 2)});
  const double covered = std::sqrt(0.75) / 2 + half_turn / 6 - 0.5;  // of the mast by the disc
  EXPECT_NEAR(area_within_curves(g), 100 - (half_turn + 1.5 - covered), 1e-6);
}

TEST(SplitCurves, ALineMayEndInTheMiddleOfTheCurvesOfBlocks) {
  AssembleOptions options;
  options.blocks = {{"low", {}, {}, Point{0, -0.5}, "case"}, {"high", {}, {}, Point{0, 0.5}, "case"}};
  Warnings warnings;
  const double y = 0.25, x = std::sqrt(1 - y * y);
  const Geometry g = assemble({true_circle("pipe", {0, 0}, 1), open_line("level", {{-1.5, y}, {1.5, y}})},
                              options, warnings);
  const double cap = std::acos(y) - y * x;
  EXPECT_NEAR(area_within_curves(g, 0), half_turn - cap, 1e-6);
  EXPECT_NEAR(area_within_curves(g, 1), cap, 1e-6);
}

TEST(SplitCurves, CommonEndsAndEqualCurvesAreNoCrossings) {
  std::vector<Chain> chains{true_circle("ring", {0, 0}, 1), true_circle("again", {0, 0}, 1),
                            open_line("tail", {{1, 0}, {2, 0}})};
  const std::vector<Chain> before = chains;
  split_curves_at_crossings(chains);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    EXPECT_EQ(chains[c].points, before[c].points);
    EXPECT_EQ(chains[c].curves, before[c].curves);
  }
}

TEST(SplitCurves, BothPiecesOfACurveFollowIt) {
  std::vector<Chain> chains{true_circle("ring", {0.2, 0.1}, 2), open_line("cut", {{0.2, 0.1}, {3.2, 2.1}})};
  split_curves_at_crossings(chains);
  ASSERT_EQ(chains[0].points.size(), 5U);
  EXPECT_EQ(chains[1].points.size(), 3U);
  EXPECT_EQ(chains[1].points[1], chains[0].points[1]);
  for (std::size_t s = 0; s < 5; ++s) {
    const CurvedSegment segment{chains[0].points[s], chains[0].curves[s], chains[0].points[(s + 1) % 5]};
    for (const double t : {0.1, 0.5, 0.8})
      EXPECT_NEAR(length(point_at(segment, t) - Point{0.2, 0.1}), 2, 1e-14);
  }
}

}  // namespace
}  // namespace quadloop
