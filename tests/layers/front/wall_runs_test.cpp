// Which stretches of the outline carry layers, and where they end.
#include "mesher/layers/front/wall_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesher/layers/front/wall_line.hpp"
#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::four_layers;
using test::outline_of;

/// A floor from (0, 0) to (4, 0) with layers, behind an "inlet" that comes down to it at `first` degrees
/// inside the domain and before an "outlet" that leaves it at `last`.
Geometry floor_between(double first, double last) {
  const auto at = [](double degrees) {
    const double angle = degrees * std::acos(-1.0) / 180;
    return Point{2 * std::cos(angle), 2 * std::sin(angle)};
  };
  const Point a = at(first), b = at(last);
  return outline_of({{{"floor", {{0, 0}}, four_layers},
                      {"outlet", {{4, 0}, {4 - b.x, b.y}}},
                      {"lid", {{4 - b.x, 8}, {a.x, 8}}},
                      {"inlet", {a}}}});
}

TEST(WallRuns, AnOpenOneEndsOnTheSidesBesideIt) {
  const auto runs = wall_runs(test::step_with_layers(four_layers));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_FALSE(runs[0].closed);
  EXPECT_EQ(runs[0].segments, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(runs[0].layers, std::vector<BoundaryId>(3, BoundaryId{0}));
}

TEST(WallRuns, AWholeLoopIsClosed) {
  const auto runs = wall_runs(test::rhombus_with_layers(four_layers, 0.25));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_TRUE(runs[0].closed);
  EXPECT_EQ(runs[0].segments, (std::vector<std::int32_t>{4, 5, 6, 7}));
}

TEST(WallRuns, OneThatPassesTheLoopsFirstPointIsOne) {
  const auto runs = wall_runs(outline_of(
      {{{"floor", {{2, 0}}, four_layers}, {"rest", {{4, 0}, {4, 4}, {0, 4}}}, {"floor", {{0, 0}, {1, 0}}}}}));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].segments, (std::vector<std::int32_t>{4, 5, 0}));
}

TEST(WallRuns, EndWhereASideLeavesAt45To135Degrees) {
  for (const double degrees : {46., 60., 90., 120., 134.}) {
    for (const auto& g : {floor_between(degrees, 90), floor_between(90, degrees)})
      EXPECT_EQ(wall_runs(g)[0].segments, (std::vector<std::int32_t>{0})) << degrees;
  }
}

TEST(WallRuns, GoOnAlongASideThatLeavesOtherwiseUpToItsFirstCorner) {
  for (const double degrees : {30., 44., 136., 160.}) {
    const Geometry behind = floor_between(90, degrees), before = floor_between(degrees, 90);
    const auto on = wall_runs(behind)[0], back = wall_runs(before)[0];
    ASSERT_GE(on.segments.size(), 2U) << degrees;
    EXPECT_EQ(on.segments[0], 0);
    EXPECT_EQ(on.segments[1], 1) << "the outlet";
    EXPECT_EQ(on.layers[1], BoundaryId{0}) << "carries the floor's layers";
    ASSERT_GE(back.segments.size(), 2U);
    EXPECT_EQ(back.segments.back(), 0);
    EXPECT_EQ(back.segments[back.segments.size() - 2], before.size() - 1) << "the inlet";
  }
}

TEST(WallRuns, OfAPlateBehindASymmetryLineTakeTheLineAlong) {
  const auto runs = wall_runs(outline_of(
      {{{"symmetry", {{-1, 0}}}, {"plate", {{0, 0}}, four_layers}, {"rest", {{2, 0}, {2, 1}, {-1, 1}}}}}));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].segments, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(runs[0].layers, std::vector<BoundaryId>(2, BoundaryId{1}));
}

TEST(WallRuns, ThereIsNoneWithoutLayers) {
  EXPECT_TRUE(wall_runs(outline_of({{{"box", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}})).empty());
}

TEST(WallRuns, BoundariesThatMeetHaveOneCount) {
  LayerSpec thicker = four_layers, more = four_layers;
  thicker.first *= 2;
  more.count += 1;
  const auto floors = [](const LayerSpec& second) {
    return outline_of(
        {{{"one", {{0, 0}}, four_layers}, {"two", {{2, 0}}, second}, {"rest", {{4, 0}, {4, 4}, {0, 4}}}}});
  };
  EXPECT_EQ(wall_runs(floors(thicker))[0].layers, (std::vector<BoundaryId>{BoundaryId{0}, BoundaryId{1}}));
  EXPECT_EQ(test::refusal([&] { wall_runs(floors(more)); }),
            "boundaries one and two meet at (2, 0), but one has 4 layers and the other 5; give both "
            "the same count");
}

TEST(WallRuns, ADirectionTurnsRoundToTheLastBit) {
  const Point a{0.1, 0.7}, b{0.35, -0.2};
  EXPECT_EQ(direction_of(a, b), -1.0 * direction_of(b, a));
  EXPECT_NEAR(length(direction_of(a, b)), 1, 1e-15);
}

/// A box from (0, 0) to (4, 4) with layers on its floor, and an inner line from the middle of the floor to
/// `tip`; the floor beyond it is boundary `beyond`: 0 the floor, 1 the rest, which has no layers.
Geometry box_with_line(Point tip, std::int32_t beyond) {
  GeometryBuilder builder;
  builder.add({0, 0}, BoundaryId{0});
  builder.add({2, 0}, BoundaryId{2});
  builder.add(tip, BoundaryId{2}, {}, true);
  builder.add({2, 0}, BoundaryId{beyond});
  builder.add({4, 0}, BoundaryId{1});
  builder.add({4, 4}, BoundaryId{1});
  builder.add({0, 4}, BoundaryId{1});
  builder.end_loop();
  std::vector<Boundary> boundaries{{.name = "floor"}, {.name = "rest"}, {.name = "screen"}};
  boundaries[0].layers = four_layers;
  return std::move(builder).geometry(std::move(boundaries));
}

TEST(WallRuns, EndOnBothSidesOfAnInnerLine) {
  for (const double x : {1.1, 2., 2.9}) {
    const Geometry g = box_with_line({x, 1}, 0);
    const auto runs = wall_runs(g);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0].segments, (std::vector<std::int32_t>{0}));
    EXPECT_EQ(runs[1].segments, (std::vector<std::int32_t>{3}));
    const WallLine line(g, runs);
    const std::int32_t begins = line.across(line.size() - 1), ends = line.size() - 1;
    EXPECT_EQ(begins, WallLine::none) << "the box has no layers there";
    std::int32_t feet = 0;
    for (std::int32_t i = 0; i < ends; ++i) {
      const std::int32_t other = line.across(i);
      if (other == WallLine::none) continue;
      ++feet;
      EXPECT_EQ(line.across(other), i);
      EXPECT_EQ(line[i].wall, (Point{2, 0}));
      EXPECT_EQ(line[i].direction, line[other].direction) << "to the last bit";
      EXPECT_EQ(line.column_at(i), line.column_at(other));
      EXPECT_EQ(line.beginning_at(i), line.beginning_at(other));
      EXPECT_EQ(line.ending_at(i) + 1, line.beginning_at(i));
    }
    EXPECT_EQ(feet, 2);
  }
}

TEST(WallRuns, AnInnerLineWithoutLayersBeyondOrAtAFlatAngleIsRefused) {
  const auto said = [](Point tip, std::int32_t beyond) {
    return test::refusal([&] { wall_runs(box_with_line(tip, beyond)); });
  };
  EXPECT_EQ(
      said({2, 1}, 1),
      "boundary floor: its layers end at (2, 0) on inner line 'screen', on the "
      "other side of which boundary rest has none; add layers with the same count there, or end the line "
      "outside the layers");
  for (const double x : {0.9, 3.1})
    EXPECT_NE(said({x, 1}, 0).find("an angle of 45 to 135 degrees"), std::string::npos) << said({x, 1}, 0);
}

}  // namespace
}  // namespace quadloop
