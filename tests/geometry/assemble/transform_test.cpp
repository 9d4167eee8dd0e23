#include "mesher/geometry/assemble/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(FarField, EnclosesTheGeometryAroundItsCentre) {
  std::vector<Chain> chains{square("body", {3, 4}, 1)};
  add_far_field(chains, far_field_box(chains, 10, "case.toml:3"), "case.toml:3");
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[1].name, "farfield");
  EXPECT_EQ(chains[1].points, (std::vector<Point>{{-7, -6}, {13, -6}, {13, 14}, {-7, 14}}));
}

TEST(FarField, RefusesATooSmallOne) {
  std::vector<Chain> chains{square("body", {3, 4}, 1)};
  const std::string message =
      refusal([&] { add_far_field(chains, far_field_box(chains, 1, "case.toml:3"), "case.toml:3"); });
  EXPECT_EQ(message.find("case.toml:3"), 0u) << message;
  EXPECT_NE(message.find("does not enclose"), std::string::npos) << message;
}

TEST(FarField, RefusesASecondOne) {
  std::vector<Chain> chains{square("farfield", {3, 4}, 1)};
  EXPECT_NE(refusal([&] {
              add_far_field(chains, far_field_box(chains, 9, "case.toml:3"), "case.toml:3");
            }).find("already"),
            std::string::npos);
}

}  // namespace
}  // namespace quadloop
