// Curves are split where other chains cross them, so that unions and blocks keep them.
#include "mesher/geometry/assemble/split_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/chain_segments.hpp"
#include "mesher/geometry/assemble/curve_meetings.hpp"
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
  EXPECT_EQ(chains[1].points.size(), 3U);
  const std::vector<Point>& ring = chains[0].points;
  EXPECT_EQ(std::ranges::count(ring, chains[1].points[1]), 1);
  EXPECT_GE(ring.size(), 5U);  // the quarter that is cut consists of pieces for one cell each
  for (std::size_t s = 0; s < ring.size(); ++s) {
    const CurvedSegment segment{ring[s], chains[0].curves[s], ring[(s + 1) % ring.size()]};
    for (const double t : {0.1, 0.5, 0.8})
      EXPECT_NEAR(length(point_at(segment, t) - Point{0.2, 0.1}), 2, 1e-14);
  }
}

Chain inner_line(Chain chain) {
  chain.inner_line = true;
  return chain;
}

/// The largest distance of points from a circle.
double off_circle(const std::vector<Point>& points, Point centre, double radius) {
  double off = 0;
  for (const Point p : points) off = std::max(off, std::abs(length(p - centre) - radius));
  return off;
}

TEST(SplitCurves, AnEndOfAnInnerLineMovesOntoTheCurve) {
  constexpr double near = 1e-9;
  for (const double beyond : {-8e-10, -1e-15, 0.0, 6e-10}) {
    SCOPED_TRACE(beyond);
    const double angle = 0.4, reach = 2 + beyond;
    const Point end{0.2 + reach * std::cos(angle), 0.1 + reach * std::sin(angle)};
    std::vector<Chain> chains{true_circle("ring", {0.2, 0.1}, 2),
                              inner_line(open_line("line", {end, {4, 1.5}}))};
    split_curves_at_crossings(chains, near, SplitChains::inner_lines);
    const std::vector<Point>& ring = chains[0].points;
    EXPECT_EQ(std::ranges::count(ring, chains[1].points.front()), 1);
    EXPECT_LT(off_circle(ring, {0.2, 0.1}, 2), 1e-14);
    EXPECT_LT(length(chains[1].points.front() - end), near);
    EXPECT_EQ(chains[1].points.size(), 2U);
  }
}

TEST(SplitCurves, AnEndOfAnInnerLineMovesOntoThePointBetweenTwoCurves) {
  // The ends of the circle's quarters differ from (0, 0.5) and (-0.5, 0) by rounding.
  std::vector<Chain> chains{true_circle("ring", {0, 0}, 0.5), open_line("up", {{0, 0.5}, {0.6, 0.7}}),
                            open_line("left", {{-0.9, 0.3}, {-0.5, 0}})};
  for (Chain& chain : chains) chain.inner_line = chain.name != "ring";
  const std::vector<Point> ring = chains[0].points;
  split_curves_at_crossings(chains, 1e-9, SplitChains::inner_lines);
  EXPECT_EQ(std::ranges::count(ring, chains[1].points.front()), 1);
  EXPECT_EQ(std::ranges::count(ring, chains[2].points.back()), 1);
}

TEST(SplitCurves, AFarEndStays) {
  std::vector<Chain> chains{true_circle("ring", {0, 0}, 2),
                            inner_line(open_line("line", {{1.9, 0}, {1, 0.5}}))};
  split_curves_at_crossings(chains, 1e-9, SplitChains::inner_lines);
  EXPECT_EQ(chains[0].points.size(), 4U);
  EXPECT_EQ(chains[1].points.front(), (Point{1.9, 0}));
}

TEST(SplitCurves, InnerLinesCrossThemselves) {
  Curve cubic;  // symmetric about x = 0.5, where it crosses itself
  cubic.inner = {{3, 2}, {-2, 2}};
  Chain loop = inner_line(open_line("loop", {{0, 0}}));
  append_segment(loop, cubic, {1, 0});
  std::vector<Chain> chains{loop};
  split_curves_at_crossings(chains, 1e-9, SplitChains::inner_lines);
  std::vector<Point> twice;
  for (const Point p : chains[0].points) {
    if (std::ranges::count(chains[0].points, p) == 2) twice.push_back(p);
  }
  ASSERT_EQ(twice.size(), 2U);
  // x = 9 t (1 - t)^2 - 6 t^2 (1 - t) + t^3 is 0.5 where 16 t^2 - 16 t + 1 = 0; y = 6 t (1 - t).
  EXPECT_NEAR(twice[0].x, 0.5, 1e-15);
  EXPECT_NEAR(twice[0].y, 6.0 / 16, 1e-15);
}

TEST(SplitCurves, ThePiecesRequestTheCellsOfTheWhole) {
  const double turn = 0.002;  // of the first piece
  std::vector<Chain> chains{
      true_circle("ring", {0, 0}, 2),
      inner_line(open_line("line", {{2 * std::cos(turn), 2 * std::sin(turn)}, {3, 0.1}}))};
  split_curves_at_crossings(chains, 1e-9, SplitChains::inner_lines);
  double least = 1;
  for (const Curve& curve : chains[0].curves) {
    if (curve.spacing > 0) least = std::min(least, curve.spacing);
  }
  EXPECT_LT(length(chains[0].points[1] - chains[0].points[0]), 0.01);
  EXPECT_GT(least, 0.35);
  EXPECT_LT(least, 0.55);
}

TEST(SplitCurves, EqualCurvesAreSplitAlike) {
  const Chain ring = true_circle("ring", {0.3, 0.1}, 2);
  Chain back = ring;
  back.name = "back";
  std::reverse(back.points.begin() + 1, back.points.end());
  back.curves = reversed(back.curves);
  std::vector<Chain> chains{ring, inner_line(back), inner_line(open_line("cut", {{-5, 0.3}, {5, 0.7}}))};
  split_curves_at_crossings(chains, 1e-9, SplitChains::inner_lines);
  ASSERT_EQ(chains[0].points.size(), chains[1].points.size());
  std::reverse(chains[1].points.begin() + 1, chains[1].points.end());
  EXPECT_EQ(chains[0].points, chains[1].points);
  EXPECT_EQ(chains[0].curves, reversed(chains[1].curves));
  EXPECT_EQ(chains[2].points.size(), 4U);
}

TEST(ChainSegments, FindEqualCurvesInEitherDirection) {
  const Chain ring = true_circle("ring", {0.3, 0.1}, 2);
  Chain arc = open_line("arc", {ring.points[1], ring.points[0]});
  arc.curves = {reversed(ring.curves[0])};
  std::vector<Chain> chains{ring, open_line("line", {{0, 0}, {1, 0}}), arc};
  const std::vector<ChainSegment> segments = segments_of(chains);
  ASSERT_EQ(segments.size(), 6U);
  EXPECT_EQ(segments[5].first_equal, 0);
  EXPECT_TRUE(segments[5].is_reverse);
  EXPECT_EQ(segments[4].first_equal, 4);
  std::vector<std::vector<CurvedSegment>> pieces(6);
  for (std::size_t i = 0; i < 5; ++i) pieces[i] = {segments[i].segment};
  const auto [first, second] = halves(segments[0].segment);
  pieces[0] = {first, second};
  replace_segments(chains, segments, pieces);
  EXPECT_EQ(chains[0].points.size(), 5U);
  EXPECT_EQ(chains[2].points, (std::vector{ring.points[1], first.to, ring.points[0]}));
  EXPECT_EQ(chains[2].curves, (std::vector{reversed(second.curve), reversed(first.curve)}));
  EXPECT_TRUE(chains[1].curves.empty());
}

TEST(CurveMeetings, OfAnArcAndLines) {
  const Chain ring = true_circle("ring", {0, 0}, 1);
  const CurvedSegment quarter{ring.points[0], ring.curves[0], ring.points[1]};
  const std::vector<CurveMeeting> crossing = meetings_of(quarter, {{0, 0}, {}, {1.6, 1.2}}, 0);
  ASSERT_EQ(crossing.size(), 1U);
  EXPECT_LT(length(crossing[0].point - Point{0.8, 0.6}), 1e-15);
  EXPECT_LT(length(point_at(quarter, crossing[0].on_first) - Point{0.8, 0.6}), 1e-15);
  EXPECT_NEAR(crossing[0].on_second, 0.5, 1e-15);
  EXPECT_EQ(meetings_of(quarter, {{0.1, 1.1}, {}, {1.1, 0.1}}, 0).size(), 2U);
  EXPECT_TRUE(meetings_of(quarter, {{0, 0}, {}, {0.79, 0.59}}, 0).empty());
  EXPECT_TRUE(meetings_of(quarter, quarter, 0).empty());
  for (const double share : {1 - 5e-10, 1 + 5e-10})
    EXPECT_EQ(meetings_of(quarter, {{0, 0}, {}, share * Point{0.8, 0.6}}, 1e-9).size(), 1U);
  EXPECT_TRUE(meetings_of(quarter, {{0, 0}, {}, (1 - 2e-9) * Point{0.8, 0.6}}, 1e-9).empty());
}

/// The message with which a domain with inner lines is refused; empty if it is not.
std::string refusal_of(std::vector<Chain> chains, std::vector<LineRule> lines) {
  AssembleOptions options;
  options.lines = std::move(lines);
  Warnings warnings;
  try {
    assemble(std::move(chains), options, warnings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SplitCurves, ATangentIsRefusedWithBothNames) {
  const std::vector<Chain> chains{outline_box("sea", -5, 5, -5, 5), true_circle("body", {0, 0}, 1)};
  const std::string text = refusal_of(chains, {{"touch", {}, {{-2, 1}, {2, 1}}, false, "case"}});
  for (const char* const part : {"'body'", "'touch'", "(", "move them apart by 1e-06 or more"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  for (const double angle : {0.0, 0.7, half_turn / 2, 4.1}) {
    for (const double distance : {1 + 1e-6, 1.01}) {
      const Point normal{std::cos(angle), std::sin(angle)}, along{-normal.y, normal.x};
      const std::vector<Point> moved{distance * normal - 2 * along, distance * normal + 2 * along};
      EXPECT_EQ(refusal_of(chains, {{"moved", {}, moved, false, "case"}}), "") << angle << " " << distance;
    }
  }
  EXPECT_EQ(refusal_of(chains, {{"clear", {}, {{-2, 1.001}, {2, 1.001}}, false, "case"}}), "");
}

}  // namespace
}  // namespace quadloop
