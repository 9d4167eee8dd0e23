#include "io/dxf/dxf_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "mesher/geometry/curve.hpp"
#include "tests/io/dxf/chain_points.hpp"
#include "tests/io/dxf/dxf_entities.hpp"

namespace quadloop::io {
namespace {

using namespace test;

class DxfCurves : public DxfTest {
 protected:
  Chain only(const std::string& entities) {
    std::vector<Chain> chains =
        read(entities.find("SECTION") < entities.size() ? entities : dxf_of(entities));
    EXPECT_EQ(chains.size(), 1u);
    return chains.empty() ? Chain{} : chains.front();
  }
};

constexpr double precise = 1e-12;

double length_of(const Chain& chain) {
  const std::vector<Point> points = along(chain);
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += length(points[i] - points[i - 1]);
  return sum;
}

/// All points have this distance from the centre.
void expect_on_circle(const Chain& chain, Point centre, double radius) {
  for (const Point p : along(chain)) EXPECT_NEAR(length(p - centre), radius, precise * radius);
}

TEST_F(DxfCurves, ACircleIsALoopOfFourArcs) {
  const Chain circle = only(dxf_circle("A1", "wall", 2.5));
  EXPECT_FALSE(circle.open);
  EXPECT_EQ(circle.points, (std::vector<Point>{{2.5, 0}, {0, 2.5}, {-2.5, 0}, {0, -2.5}}));
  EXPECT_EQ(circle.curves.size(), 4u);
  expect_on_circle(circle, {0, 0}, 2.5);
  EXPECT_NEAR(length_of(circle), 5 * std::numbers::pi, 1e-3);
}

TEST_F(DxfCurves, AnArcRunsCounterClockwise) {
  const Chain quarter = only(dxf_arc("wall", 1, 2, 3, 90, 180));
  EXPECT_TRUE(quarter.open);
  EXPECT_EQ(quarter.points.front(), (Point{1, 5}));
  EXPECT_EQ(quarter.points.back(), (Point{-2, 2}));
  expect_on_circle(quarter, {1, 2}, 3);
  const Chain most = only(dxf_arc("wall", 1, 2, 3, 20, -10));  // 330 degrees, across 0
  expect_on_circle(most, {1, 2}, 3);
  EXPECT_NEAR(length_of(most), 3 * 330 * std::numbers::pi / 180, 1e-2);
  EXPECT_FALSE(only(dxf_arc("wall", 1, 2, 3, 45, 405)).open) << "a whole turn";
}

TEST_F(DxfCurves, AnExtrusionDownwardsMirrorsAnArc) {
  const Chain arc = only(dxf_arc("wall", 1, 2, 3, 90, 180) + groups(210, 0, 220, 0, 230, -1));
  EXPECT_EQ(arc.points.front(), (Point{-1, 5}));
  EXPECT_EQ(arc.points.back(), (Point{2, 2}));
  expect_on_circle(arc, {-1, 2}, 3);
  const Chain tilted = only(dxf_circle("A1", "wall", 5) + groups(30, 10, 210, 0.8, 220, 0, 230, 0.6));
  for (const Point p : along(tilted)) EXPECT_NEAR(std::hypot((p.x - 8) / 3, p.y / 5), 1, precise);
}

std::string dxf_ellipse(double begin, double end, const std::string& more = "") {
  return groups(0, "ELLIPSE", 8, "wall", 10, 1, 20, 2, 11, 3, 21, 4, 40, 0.5) + groups(41, begin, 42, end) +
         more;
}

void expect_on_ellipse(const Chain& chain) {  // half axes 5 along (3, 4), and 2.5
  for (const Point p : along(chain)) {
    const Point arm = p - Point{1, 2};
    EXPECT_NEAR(std::hypot(dot(arm, {3, 4}) / 25, cross({3, 4}, arm) / 12.5), 1, precise);
  }
}

TEST_F(DxfCurves, EllipsesAreExact) {
  const Chain whole = only(dxf_ellipse(0, 6.28319));
  EXPECT_FALSE(whole.open);
  EXPECT_EQ(whole.points.front(), (Point{4, 6}));
  EXPECT_EQ(whole.points[1], (Point{-1, 3.5}));
  expect_on_ellipse(whole);
  const Chain part = only(dxf_ellipse(1, 5.5));
  EXPECT_TRUE(part.open);
  expect_on_ellipse(part);
  const Point begin = Point{1, 2} + std::cos(1) * Point{3, 4} + std::sin(1) * Point{-2, 1.5};
  EXPECT_LE(length(part.points.front() - begin), precise);
  const Chain across = only(dxf_ellipse(5.5, 1));  // across 0
  expect_on_ellipse(across);
  EXPECT_NEAR(length_of(part) + length_of(across), length_of(whole), 1e-2);
}

TEST_F(DxfCurves, AnEllipseWithAnExtrusionDownwardsRunsClockwise) {
  const Chain part = only(dxf_ellipse(1, 5.5, groups(210, 0, 220, 0, 230, -1)));
  expect_on_ellipse(part);
  const Point begin = Point{1, 2} + std::cos(1) * Point{3, 4} - std::sin(1) * Point{-2, 1.5};
  EXPECT_LE(length(part.points.front() - begin), precise);
}

std::string poles(std::initializer_list<Point> points) {
  std::string text;
  for (const Point p : points) text += groups(10, p.x, 20, p.y, 30, 0);
  return text;
}

std::string numbers(int code, std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += groups(code, value);
  return text;
}

TEST_F(DxfCurves, ASplineHasAPointAtEachKnot) {
  // Two parabolas that meet in a kink at (2, 0), where the knot has the degree for its multiplicity.
  const Chain chain =
      only(entity("SPLINE", "B1", groups(8, "wall", 70, 8, 71, 2, 72, 8, 73, 5)) +
           numbers(40, {0, 0, 0, 1, 1, 3, 3, 3}) + poles({{0, 0}, {1, 2}, {2, 0}, {3, 2}, {4, 0}}));
  EXPECT_EQ(chain.points, (std::vector<Point>{{0, 0}, {2, 0}, {4, 0}}));
  for (const Point p : along(chain)) {
    const double x = p.x < 2 ? p.x : p.x - 2;
    EXPECT_NEAR(p.y, x * (2 - x), precise);
  }
}

TEST_F(DxfCurves, ARationalSplineIsACircle) {
  const double w = std::numbers::sqrt2 / 2;
  const Chain circle =
      only(entity("SPLINE", "B1", groups(8, "wall", 70, 12, 71, 2)) +
           numbers(40, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}) + numbers(41, {1, w, 1, w, 1, w, 1, w, 1}) +
           poles({{7, 1}, {7, 5}, {3, 5}, {-1, 5}, {-1, 1}, {-1, -3}, {3, -3}, {7, -3}, {7, 1}}));
  EXPECT_FALSE(circle.open);
  EXPECT_EQ(circle.points.size(), 4u);
  expect_on_circle(circle, {3, 1}, 4);
}

TEST_F(DxfCurves, ALoopOfOneCurveHasFourSegments) {
  const Chain leaf = only(entity("SPLINE", "B1", groups(8, "wall", 71, 3)) +
                          numbers(40, {0, 0, 0, 0, 1, 1, 1, 1}) + poles({{0, 0}, {4, 4}, {-4, 4}, {0, 0}}));
  EXPECT_FALSE(leaf.open);
  EXPECT_EQ(leaf.points.size(), 4u);
  EXPECT_EQ(leaf.points[2], (Point{0, 3}));
  const auto points = along(leaf);
  EXPECT_NEAR(points[32].x, 0.984375, precise);  // at an eighth: 12 t (1 - t) (1 - 2 t)
}

TEST_F(DxfCurves, APeriodicSplineIsClosed) {
  const Chain ring = only(entity("SPLINE", "B1", groups(8, "wall", 70, 11, 71, 3)) +
                          numbers(40, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}) +
                          poles({{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}));
  EXPECT_FALSE(ring.open);
  EXPECT_EQ(ring.points.size(), 4u);
  for (const Point p : along(ring)) EXPECT_NEAR(length(p), 0.66, 0.02);
}

std::string fit_points(const std::string& more, std::initializer_list<Point> points) {
  std::string text = entity("SPLINE", "B7", groups(8, "rim", 71, 3, 72, 0, 73, 0, 74, points.size())) + more;
  for (const Point p : points) text += groups(11, p.x, 21, p.y, 31, 0);
  return text;
}

/// A plane cubic in the chord length would be reproduced; a straight line with unequal steps is one.
TEST_F(DxfCurves, ASplineOfFitPointsRunsThroughThem) {
  const std::initializer_list<Point> through{{0, 0}, {1, 1}, {2, 0.5}, {3, 2}};
  const Chain free = only(fit_points("", through));
  EXPECT_EQ(free.points, std::vector<Point>(through));
  EXPECT_TRUE(free.open);
  const Chain held = only(fit_points(groups(12, 0, 22, 2, 13, 1, 23, 0), through));
  EXPECT_EQ(held.points, std::vector<Point>(through));
  EXPECT_LE(length(direction_at_start(segment_of(held, 0)) - Point{0, 1}), precise);
  EXPECT_LE(length(direction_at_end(segment_of(held, 2)) - Point{1, 0}), precise);
  for (const Chain& chain : {free, held}) {
    for (std::size_t i = 1; i < 3; ++i)
      EXPECT_LE(length(direction_at_end(segment_of(chain, i - 1)) - direction_at_start(segment_of(chain, i))),
                precise)
          << i;
  }
  const Chain closed = only(fit_points(groups(70, 1), {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}}));
  EXPECT_FALSE(closed.open);
  EXPECT_EQ(closed.points.size(), 4u);
  EXPECT_LE(length(direction_at_end(segment_of(closed, 3)) - Point{0, 1}), precise);
}

TEST_F(DxfCurves, RefusesSplinesThatDefineNoCurve) {
  const std::string spline = entity("SPLINE", "B7", groups(8, "rim", 71, 3));
  const std::string said = refused(dxf_of(spline + numbers(40, {0, 1, 2}) + poles({{0, 0}, {1, 1}})));
  EXPECT_EQ(said.find("a.dxf:5: layer 'rim', SPLINE of handle B7: it has 2 control points, but its degree 3"),
            0u)
      << said;
  EXPECT_NE(refused(dxf_of(spline)).find("B7: it has too few different fit points"), std::string::npos);
  EXPECT_NE(refused(dxf_of(fit_points(groups(70, 1), {{1, 0}, {0, 1}, {1, 0}}))).find("too few different"),
            std::string::npos);
}

std::string dxf_polyline(const std::string& type, int flags,
                         std::initializer_list<std::array<double, 3>> vertices) {
  const bool light = type == "LWPOLYLINE";
  std::string text =
      entity(type, "C1", groups(8, "slot", light ? 90 : 66, light ? vertices.size() : 1, 70, flags));
  for (const auto& [x, y, bulge] : vertices) {
    if (!light) text += groups(0, "VERTEX", 8, "slot");
    text += groups(10, x, 20, y);
    if (bulge != 0) text += groups(42, bulge);
  }
  return text + (light ? "" : groups(0, "SEQEND", 8, "slot"));
}

TEST_F(DxfCurves, BulgesAreArcs) {
  for (const char* const type : {"LWPOLYLINE", "POLYLINE"}) {
    const Chain slot = only(dxf_polyline(type, 1, {{0, 0, 0}, {4, 0, 1}, {4, 2, 0}, {0, 2, 1}}));
    EXPECT_FALSE(slot.open) << type;
    int on_ends = 0;
    for (const Point p : along(slot)) {
      if (p.x >= 0 && p.x <= 4) {
        EXPECT_TRUE(p.y == 0 || p.y == 2 || p.x == 0 || p.x == 4);
      } else {
        EXPECT_NEAR(length(p - Point{p.x < 0 ? 0. : 4., 1}), 1, precise);
        ++on_ends;
      }
    }
    EXPECT_GT(on_ends, 200);
  }
}

TEST_F(DxfCurves, BulgesOfMoreThanHalfACircle) {
  const double bulge = std::tan(300 * std::numbers::pi / 180 / 4);  // 300 degrees
  for (const double sign : {1., -1.}) {
    const Chain arc = only(dxf_polyline("LWPOLYLINE", 0, {{0, 0, sign * bulge}, {1, 0, 0}}));
    EXPECT_TRUE(arc.open);
    EXPECT_EQ(arc.points.front(), (Point{0, 0}));
    EXPECT_EQ(arc.points.back(), (Point{1, 0}));
    expect_on_circle(arc, {0.5, -sign * std::sqrt(3) / 2}, 1);
    EXPECT_NEAR(length_of(arc), 300 * std::numbers::pi / 180, 1e-2);
  }
}

TEST_F(DxfCurves, TwoBulgesAreALoop) {
  const Chain circle = only(dxf_polyline("LWPOLYLINE", 1, {{-1, 0, 1}, {1, 0, 1}}));
  EXPECT_FALSE(circle.open);
  expect_on_circle(circle, {0, 0}, 1);
  const Chain lens = only(dxf_polyline("POLYLINE", 1, {{-1, 0, 0.25}, {1, 0, 0.25}}));
  EXPECT_FALSE(lens.open);
  EXPECT_GE(lens.points.size(), 4u) << "a loop needs three points";
  for (const Point p : along(lens))
    EXPECT_NEAR(length(p + Point{0, p.y > 0 ? 1.875 : -1.875}), 2.125, precise);
}

TEST_F(DxfCurves, ClosedFlagsAndRepeatedVertices) {
  EXPECT_TRUE(only(dxf_polyline("LWPOLYLINE", 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})).open);
  const Chain drawn = only(dxf_polyline("LWPOLYLINE", 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}));
  EXPECT_FALSE(drawn.open) << "the ends coincide";
  EXPECT_EQ(drawn.points.size(), 3u);
  const Chain twice =
      only(dxf_polyline("LWPOLYLINE", 1, {{0, 0, 0}, {2, 0, 1}, {2, 0, 1}, {0, 2, 0}, {0, 0, 1}}));
  EXPECT_FALSE(twice.open);
  EXPECT_EQ(twice.points.size(), twice.curves.size());
  for (std::size_t i = 0; i < segments_of(twice); ++i) {
    const CurvedSegment segment = segment_of(twice, i);
    EXPECT_GT(length(segment.to - segment.from), 0.1) << i;
  }
}

TEST_F(DxfCurves, VerticesThatControlASplineAreNoPoints) {
  std::string text = entity("POLYLINE", "C1", groups(8, "slot", 66, 1, 70, 4));
  for (const auto& [x, y, flags] :
       {std::array<int, 3>{0, 0, 16}, {1, 5, 16}, {2, 0, 16}, {0, 0, 8}, {1, 2, 8}, {2, 0, 8}})
    text += groups(0, "VERTEX", 8, "slot", 10, x, 20, y, 70, flags);
  EXPECT_EQ(only(text + groups(0, "SEQEND")).points, (std::vector<Point>{{0, 0}, {1, 2}, {2, 0}}));
}

TEST_F(DxfCurves, AMirroredScaleMirrorsCurves) {
  const std::string arc = dxf_arc("0", 1, 2, 3, 20, 300),
                    spline = fit_points("", {{0, 0}, {1, 1}, {2, 0.5}, {3, 2}}),
                    bulge = dxf_polyline("LWPOLYLINE", 1, {{0, 0, .3}, {4, 0, -2}, {4, 2, 0}});
  for (const std::string& curve : {arc, spline, bulge}) {
    const Chain drawn = only(curve);
    const std::string in_block = section("BLOCKS", block_of("b", curve));
    Chain mirrored = only(in_block + dxf_of(insert_of("b", "w", groups(41, -1))));
    for (Point& p : mirrored.points) p.x = -p.x;
    for (Curve& c : mirrored.curves) std::ranges::for_each(c.inner, [](Point& p) { p.x = -p.x; });
    EXPECT_EQ(mirrored.points, drawn.points);
    EXPECT_EQ(mirrored.curves, drawn.curves);
  }
  const std::string in_blocks =
      section("BLOCKS", block_of("a", arc) + block_of("b", insert_of("a", "0", groups(42, -1))));
  const Chain back = only(in_blocks + dxf_of(insert_of("b", "w", groups(42, -1))));
  EXPECT_EQ(back.curves, only(arc).curves);
}

TEST_F(DxfCurves, AnUnequalScaleMakesAnEllipse) {
  const std::string blocks = section("BLOCKS", block_of("b", dxf_circle("A1", "0", 1)));
  const Chain ellipse =
      only(blocks + dxf_of(insert_of("b", "w", groups(10, 1, 20, 2, 41, 5, 42, 2.5, 50, 30))));
  const Point along_x{std::sqrt(3) / 2, 0.5};
  for (const Point p : along(ellipse)) {
    const Point arm = p - Point{1, 2};
    EXPECT_NEAR(std::hypot(dot(arm, along_x) / 5, cross(along_x, arm) / 2.5), 1, precise);
  }
}

}  // namespace
}  // namespace quadloop::io
