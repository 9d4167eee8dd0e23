// Stations of a wall: how near they stand, and what the wall does at each.
#include "mesher/layers/front/wall_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::four_layers;

using Shape = Station::Shape;

/// An outline with its wall's stations.
struct Wall {
  explicit Wall(Geometry g) : geometry{std::move(g)}, line(geometry, wall_runs(geometry)) {}
  std::int32_t at(Point p) const {
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (line[i].wall == p) return i;
    }
    return WallLine::none;
  }
  std::int32_t count(Shape shape) const {
    std::int32_t found = 0;
    for (std::int32_t i = 0; i < line.size(); ++i) found += line[i].shape == shape ? 1 : 0;
    return found;
  }
  Geometry geometry;
  WallLine line;
};

TEST(WallLine, StationsAreAnEighthOfTheThicknessApart) {
  const Wall floor(test::floor_with_layers(four_layers));
  EXPECT_EQ(floor.line.size(), 129);
  for (std::int32_t i = 0; i + 1 < floor.line.size(); ++i) {
    EXPECT_EQ(floor.line.width(i), 0.0625);
    EXPECT_EQ(floor.line.next(i), i + 1);
    EXPECT_EQ(floor.line.previous(i + 1), i);
    EXPECT_EQ(floor.line.asked(i), 0.5);
    EXPECT_EQ(floor.line[i].segment, 0);
    EXPECT_EQ(floor.line[i].direction, (Point{0, 1}));
  }
  EXPECT_EQ(floor.line.next(128), WallLine::none);
  EXPECT_EQ(floor.line.previous(0), WallLine::none);
  EXPECT_EQ(floor.line.width(128), 0);
}

/// A floor of a length of 4 between sides, with layers so thin.
Geometry long_floor(double thickness, double spacing) {
  return test::outline_of(
      {{{"floor", {{-2, 0}}, test::equal_layers(thickness, 4)}, {"rest", {{2, 0}, {2, 2}, {-2, 2}}}}},
      spacing);
}

TEST(WallLine, FarFromCornersStationsStandWider) {
  const Wall floor(long_floor(0.01, 1));
  const WallLine &line = floor.line;
  EXPECT_LT(line.size(), 400) << "not 3200";
  for (std::int32_t i = 0; i + 1 < line.size(); ++i) {
    const double near = std::min(2 + line[i].wall.x, 2 - line[i + 1].wall.x);
    if (near < 0.07) {
      EXPECT_NEAR(line.width(i), 0.01 / 8, 2e-4) << near;
    }
    EXPECT_LE(line.width(i), 0.01 / 8 + near / 8 + 1e-12);
    EXPECT_LE(line.width(i), 0.25);
    if (i > 0) {
      EXPECT_LT(line.width(i), 1.2 * line.width(i - 1));
    }
    const std::int32_t mirrored = line.size() - 1 - i;
    EXPECT_EQ(line[i].wall.x, -line[mirrored].wall.x);
  }
}

TEST(WallLine, ThinLayersTakeFewStations) {
  const std::int32_t thin = Wall(long_floor(1e-6, 1)).line.size(),
                     thinner = Wall(long_floor(1e-9, 1)).line.size();
  EXPECT_LT(thin, 400);
  EXPECT_LT(thinner, 600);
  EXPECT_GT(Wall(long_floor(1e-6, 0.01)).line.size(), 1600) << "four for each cell along the wall";
}

TEST(WallLine, ARunEndsOnTheSideThatIsMetThere) {
  const Wall slanted(
      test::outline_of({{{"floor", {{0, 0}}, four_layers}, {"rest", {{4, 0}, {3, 2}, {-1, 2}}}}}));
  const Station &first = slanted.line[0], &last = slanted.line[slanted.line.size() - 1];
  for (const Station &end : {first, last}) {
    EXPECT_EQ(end.shape, Shape::end);
    EXPECT_TRUE(end.kept);
    EXPECT_TRUE(end.fixed());
    EXPECT_NEAR(end.direction.x, -1 / std::sqrt(5.0), 1e-15);
    EXPECT_NEAR(end.direction.y, 2 / std::sqrt(5.0), 1e-15);
  }
  EXPECT_NEAR(first.slope, -0.5, 1e-15) << "leans out of the run";
  EXPECT_NEAR(last.slope, 0.5, 1e-15) << "leans into it";
}

TEST(WallLine, TellsCornersByTheirTurns) {
  const Wall step(test::step_with_layers(four_layers));
  const Station &in = step.line[step.at({4, 0})], &out = step.line[step.at({4, 2})];
  EXPECT_EQ(in.shape, Shape::concave);
  EXPECT_TRUE(in.kept);
  EXPECT_NEAR(in.slope, 1, 1e-15) << "the tangent of 45 degrees";
  EXPECT_NEAR(in.direction.x, -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(in.direction.y, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(out.shape, Shape::smooth) << "one bisector";
  EXPECT_TRUE(out.kept);
  EXPECT_EQ(out.slope, 0);
  EXPECT_EQ(step.count(Shape::end), 2);
  EXPECT_EQ(step.count(Shape::concave), 1);
  EXPECT_EQ(step.count(Shape::fan), 0);
}

TEST(WallLine, ASharpEdgeHasAFan) {
  const Wall body(test::rhombus_with_layers(four_layers, 0.25));
  EXPECT_EQ(body.count(Shape::fan), 34);
  const std::int32_t first = body.at({2, 0});
  const Point up = body.line[first].direction;
  EXPECT_NEAR(dot(up, body.line[first].before), 0, 1e-15) << "the first ray is normal to the wall before";
  EXPECT_NEAR(dot(body.line[first + 16].direction, body.line[first].after), 0, 1e-15);
  for (std::int32_t k = 0; k <= 16; ++k) {
    const Station &ray = body.line[first + k], &image = body.line[first + 16 - k];
    EXPECT_EQ(ray.wall, (Point{2, 0}));
    EXPECT_EQ(ray.kept, k == 0 || k == 16);
    EXPECT_NEAR(length(ray.direction), 1, 1e-15);
    EXPECT_EQ(ray.direction.x, image.direction.x) << "bit for bit";
    EXPECT_EQ(ray.direction.y, -image.direction.y);
    if (k == 16) break;
    EXPECT_EQ(body.line.width(first + k), 0);
    EXPECT_LT(cross(ray.direction, body.line[first + k + 1].direction), 0) << "they turn clockwise";
    EXPECT_NEAR(dot(ray.direction, body.line[first + k + 1].direction), std::cos(165.75 / 16 * 0.0174533),
                1e-4);
  }
}

TEST(WallLine, OneBisectorAtTheBluntCornersOfABase) {
  const Wall body(test::outline_of({{{"box", {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}}},
                                    {{"body", {{-2, 0}, {2, 0.25}, {2, -0.25}}, four_layers}}}));
  EXPECT_EQ(body.count(Shape::fan), 17) << "at the nose alone";
  EXPECT_EQ(body.line[body.at({2, 0.25})].shape, Shape::smooth);
}

TEST(WallLine, WalksMeasureAlongTheWallFromTheStationOn) {
  const Wall step(test::step_with_layers(four_layers));
  const std::int32_t corner = step.at({4, 0});
  std::vector<double> on, back;
  step.line.walk_on(corner, 0.2, [&](std::int32_t i, double distance) {
    EXPECT_EQ(step.line[i].wall, (Point{4, distance}));
    on.push_back(distance);
  });
  step.line.walk_back(corner, 0.2, [&](std::int32_t i, double distance) {
    EXPECT_EQ(step.line[i].wall, (Point{4 - distance, 0}));
    back.push_back(distance);
  });
  EXPECT_EQ(on, (std::vector<double>{0.0625, 0.125, 0.1875}));
  EXPECT_EQ(back, on);
}

TEST(WallLine, AWalkRoundALoopVisitsEachStationOnce) {
  const Wall body(test::rhombus_with_layers(four_layers, 0.25));
  std::int32_t visits = 0;
  body.line.walk_on(5, 1e9, [&](std::int32_t i, double) { visits += i == 5 ? 1000 : 1; });
  EXPECT_EQ(visits, body.line.size() - 1);
  visits = 0;
  body.line.walk_back(5, 1e9, [&](std::int32_t i, double) { visits += i == 5 ? 1000 : 1; });
  EXPECT_EQ(visits, body.line.size() - 1);
}

TEST(WallLine, CountsStepsOnOneLineOfWall) {
  const Wall floor(test::floor_with_layers(four_layers)), body(test::rhombus_with_layers(four_layers, 0.25));
  EXPECT_EQ(floor.line.steps(3, 7), 4);
  EXPECT_EQ(floor.line.steps(7, 3), WallLine::none) << "an open one has no way back";
  EXPECT_EQ(body.line.steps(3, 7), 4);
  EXPECT_EQ(body.line.steps(7, 3), body.line.size() - 4);
  const Wall two(test::outline_of({{{"box", {{0, 0}, {8, 0}, {8, 8}, {0, 8}}, four_layers}},
                                   {{"body", {{3, 3}, {3, 5}, {5, 5}, {5, 3}}, four_layers}}}));
  EXPECT_EQ(two.line.steps(0, two.line.size() - 1), WallLine::none);
}

}  // namespace
}  // namespace quadloop
