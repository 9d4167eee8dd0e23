#include "mesher/geometry/assemble/transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/geometry/assemble/curved_chain.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

using test::refusal;
using test::square;

Point transformed(Point p, const Transform& transform) {
  std::vector<Chain> chains{{"point", false, {p}, ""}};
  apply(transform, chains);
  return chains[0].points[0];
}

TEST(Transform, QuarterTurnsAreExact) {
  const Point p{0.1, 0.7};
  EXPECT_EQ(transformed(p, {1, 90, {}}), (Point{-0.7, 0.1}));
  EXPECT_EQ(transformed(p, {1, -180, {}}), (Point{-0.1, -0.7}));
  EXPECT_EQ(transformed(p, {1, 270, {}}), (Point{0.7, -0.1}));
  EXPECT_EQ(transformed(p, {1, 720, {}}), p);
}

TEST(Transform, ScalesThenTurnsThenMoves) {
  const Point p = transformed({1, 0}, {2, 90, {10, 20}});
  EXPECT_EQ(p, (Point{10, 22}));
  EXPECT_NEAR(transformed({1, 0}, {1, 30, {}}).y, 0.5, 1e-15);
}

void add(std::vector<Chain>& chains, FarFieldShape shape, double radius) {
  add_far_field(chains, shape, far_field_box(chains, shape, radius, "case.toml:3"), "case.toml:3");
}

TEST(FarField, EnclosesTheGeometryAroundItsCentre) {
  std::vector<Chain> chains{square("body", {3, 4}, 1)};
  add(chains, FarFieldShape::square, 10);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[1].name, "farfield");
  EXPECT_EQ(chains[1].points, (std::vector<Point>{{-7, -6}, {13, -6}, {13, 14}, {-7, 14}}));
}

TEST(FarField, RefusesATooSmallOne) {
  std::vector<Chain> chains{square("body", {3, 4}, 1)};
  const std::string message = refusal([&] { add(chains, FarFieldShape::square, 1); });
  EXPECT_EQ(message.find("case.toml:3"), 0u) << message;
  EXPECT_NE(message.find("of half width 1 around (3, 4) does not enclose"), std::string::npos) << message;
  for (const FarFieldShape round : {FarFieldShape::circle, FarFieldShape::rounded_front}) {
    const std::string of_round = refusal([&] { add(chains, round, 1); });
    EXPECT_NE(of_round.find("of radius 1 around (3, 4) does not enclose"), std::string::npos) << of_round;
  }
}

TEST(FarField, ARectangleHasOneDistanceFromTheGeometry) {
  std::vector<Chain> chains{{"body", false, {{0, 0}, {4, 0}, {4, 1}}, ""}};
  add(chains, FarFieldShape::rectangle, 2);
  EXPECT_EQ(chains[1].points, (std::vector<Point>{{-2, -2}, {6, -2}, {6, 3}, {-2, 3}}));
}

/// The largest and the smallest distance of points of the boundary from a centre, on the side of x < 0 and on
/// the other.
struct Distances {
  double least[2]{1e9, 1e9}, largest[2]{0, 0};
};
Distances distances(const Chain& chain, Point centre) {
  Distances found;
  const std::size_t count = chain.points.size();
  EXPECT_EQ(chain.curves.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const double t : {0.0, 0.2, 0.5, 0.9}) {
      const CurvedSegment segment{chain.points[i], chain.curves[i], chain.points[(i + 1) % count]};
      const Point arm = point_at(segment, t) - centre;
      const int behind = arm.x > 1e-9 ? 1 : 0;
      found.least[behind] = std::min(found.least[behind], length(arm));
      found.largest[behind] = std::max(found.largest[behind], length(arm));
    }
  }
  return found;
}

TEST(FarField, ACircleIsRoundAndTheLetterCInFrontOnly) {
  for (const FarFieldShape shape : {FarFieldShape::circle, FarFieldShape::rounded_front}) {
    std::vector<Chain> chains{square("body", {3, 4}, 1)};
    add(chains, shape, 10);
    const Distances found = distances(chains[1], {3, 4});
    const bool is_round = shape == FarFieldShape::circle;
    EXPECT_NEAR(found.least[0], 10, 1e-12);
    EXPECT_NEAR(found.largest[0], 10, 1e-12);
    EXPECT_NEAR(found.largest[1], is_round ? 10 : 10 * std::numbers::sqrt2, 1e-12);
  }
}

TEST(FarField, RefusesACircleThatCutsCornersOff) {
  std::vector<Chain> chains{square("body", {3, 4}, 1)};
  const std::string message = refusal([&] { add(chains, FarFieldShape::circle, 1.4); });
  EXPECT_NE(message.find("make it larger than 1.4142"), std::string::npos) << message;
  add(chains, FarFieldShape::circle, 1.42);
  EXPECT_EQ(chains.size(), 2u);
}

TEST(FarField, RefusesASecondOne) {
  std::vector<Chain> chains{square("farfield", {3, 4}, 1)};
  const std::string message = refusal([&] { add(chains, FarFieldShape::circle, 9); });
  EXPECT_NE(message.find("already"), std::string::npos) << message;
}

}  // namespace
}  // namespace quadloop
