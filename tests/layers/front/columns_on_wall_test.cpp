// Directions and lengths of columns: on straight walls, at corners, on bodies.
#include "mesher/layers/front/columns_on_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::four_layers;

/// The columns on an outline's walls, of the thickness that is asked for.
struct Columned {
  explicit Columned(Geometry g) : geometry{std::move(g)}, line(geometry, wall_runs(geometry)) {
    std::vector<double> asked;
    for (std::int32_t i = 0; i < line.size(); ++i) asked.push_back(line.asked(i));
    columns = ColumnsOnWall(line).fit(asked);
  }
  Point front(std::int32_t i) const { return columns.front(line, i); }
  /// The cosine of the larger tilt against the wall before and after.
  double cosine(std::int32_t i) const { return cosine(i, columns.direction[i]); }
  double cosine(std::int32_t i, Point d) const {
    return std::min(dot(d, left_of(line[i].before)), dot(d, left_of(line[i].after)));
  }
  /// Columns tilt by at most 57 degrees, at sharper corners as the bisector does.
  double least_cosine(std::int32_t i) const { return std::min(0.55, cosine(i, line[i].direction) - 1e-3); }
  Geometry geometry;
  WallLine line;
  WallColumns columns;
};

TEST(ColumnsOnWall, StandNormalToAStraightWall) {
  const Columned floor(test::floor_with_layers(four_layers));
  for (std::int32_t i = 0; i < floor.line.size(); ++i) {
    EXPECT_EQ(floor.columns.direction[i], (Point{0, 1}));
    EXPECT_EQ(floor.columns.length[i], 0.5);
  }
}

TEST(ColumnsOnWall, BesideAConcaveCornerTheFrontIsTheWallsOffsetLine) {
  const Columned step(test::step_with_layers(four_layers));
  std::int32_t beside = 0;
  for (std::int32_t i = 0; i < step.line.size(); ++i) {
    const Point wall = step.line[i].wall, front = step.front(i);
    if (wall.y == 0) {
      EXPECT_NEAR(front.y, 0.5, 1e-14) << wall.x;
    }
    if (wall.x == 4 && wall.y < 1.25) {
      EXPECT_NEAR(front.x, 3.5, 1e-14) << wall.y;
    }
    if (wall.y == 0 && 3 < wall.x && wall.x < 4) {
      ++beside;
      EXPECT_NEAR(front.x, 3 + (wall.x - 3) / 2, 1e-14) << "half of the wall's width, up to a thickness away";
    }
    if (wall.y == 0 && wall.x <= 3) {
      EXPECT_EQ(front.x, wall.x);
    }
  }
  EXPECT_EQ(beside, 15);
}

TEST(ColumnsOnWall, AnEndLiesOnItsSideAndTheOthersLeanWithIt) {
  const Columned slanted(
      test::outline_of({{{"floor", {{0, 0}}, four_layers}, {"rest", {{8, 0}, {7, 2}, {-1, 2}}}}}));
  const std::int32_t last = slanted.line.size() - 1;
  EXPECT_NEAR(slanted.front(last).x, 7.75, 1e-14);
  EXPECT_NEAR(slanted.front(0).x, -0.25, 1e-14);
  for (std::int32_t i = 0; i <= last; ++i)
    EXPECT_NEAR(slanted.front(i).y, 0.5, slanted.line[i].wall.x < 1 ? 0.04 : 1e-14)
        << i << ": where columns spread, before the leaning inlet, they keep their own length";
  for (std::int32_t i = 0; i < last; ++i) {
    const double ratio = (slanted.front(i + 1).x - slanted.front(i).x) / slanted.line.width(i);
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 2);
  }
}

TEST(ColumnsOnWall, SpreadAtAConvexCornerWithTheirOwnLength) {
  const Columned step(test::step_with_layers(four_layers));
  int corners = 0;
  for (std::int32_t i = 0; i < step.line.size(); ++i) {
    if (step.line[i].wall != Point{4, 2}) continue;
    ++corners;
    EXPECT_LT(step.columns.length[i], 0.57) << "no horn at the corner, which would be 0.707 long";
    EXPECT_NEAR(step.columns.direction[i].x, -std::sqrt(0.5), 1e-12);
    EXPECT_LT(step.columns.direction[i + 1].x, -0.05) << "its turn is spread over the wall";
    EXPECT_GT(step.columns.direction[i + 1].x, step.columns.direction[i].x);
  }
  EXPECT_EQ(corners, 1);
}

TEST(ColumnsOnWall, RiseVisiblyEverywhereAndNeverCrossTheirNeighbours) {
  for (const Geometry& g :
       {test::step_with_layers(four_layers), test::rhombus_with_layers(four_layers, 0.25),
        test::rhombus_with_layers(four_layers, 1.5), test::rhombus_with_layers(four_layers, 3)}) {
    const Columned c(g);
    for (std::int32_t i = 0; i < c.line.size(); ++i) {
      if (c.line[i].shape != Station::Shape::fan) {
        EXPECT_GE(c.cosine(i), c.least_cosine(i)) << i;
      }
      EXPECT_NEAR(length(c.columns.direction[i]), 1, 1e-14);
      const std::int32_t j = c.line.next(i);
      if (j == WallLine::none || c.line.width(i) == 0) continue;
      const double ratio = dot(c.front(j) - c.front(i), c.line[i].after) / c.line.width(i);
      EXPECT_GE(ratio, 0.3 - 1e-12) << i;
      EXPECT_LE(ratio, 6 + 1e-12) << i;
    }
  }
}

TEST(ColumnsOnWall, AtACornerTheyDoNotStandOutFromThoseBesideIt) {
  // A short base, with turns of 79 and 99 degrees: its columns lean to the side of the larger one.
  const Point upper{0, 0}, lower{-0.17, -0.295};
  const Columned body(test::outline_of({{{"box", {{-16, -16}, {16, -16}, {16, 16}, {-16, 16}}}},
                                        {{"body", {{-5.6, 5.7}, upper, lower, {-6.5, 4.6}}, four_layers}}}));
  int corners = 0;
  for (std::int32_t i = 0; i < body.line.size(); ++i) {
    if (body.line[i].wall != upper && body.line[i].wall != lower) continue;
    ++corners;
    const std::vector<double>& lengths = body.columns.length;
    const double beside = std::max(lengths[body.line.previous(i)], lengths[body.line.next(i)]);
    EXPECT_LE(lengths[i], 1.055 * beside) << body.line[i].wall.x;
  }
  EXPECT_EQ(corners, 2);
}

TEST(ColumnsOnWall, AtABaseThinnerThanTheLayersTheyDoNotLieFlat) {
  // Turns of 71 degrees at both corners of a base that is a fourteenth of the layers' thickness wide.
  const Point upper{0, 0.018}, lower{0, -0.018};
  const Columned body(test::outline_of({{{"box", {{-16, -16}, {16, -16}, {16, 16}, {-16, 16}}}},
                                        {{"body", {{-4, -1.4}, {-4, 1.4}, upper, lower}, four_layers}}}));
  int corners = 0;
  double front_of_base = 0;
  for (std::int32_t i = 0; i < body.line.size(); ++i) {
    EXPECT_GE(body.cosine(i), body.least_cosine(i)) << body.line[i].wall.x << ", " << body.line[i].wall.y;
    const std::int32_t j = body.line.next(i);
    if (body.line[i].wall.x == 0 && body.line[j].wall.x == 0)
      front_of_base += length(body.front(j) - body.front(i));
    if (body.line[i].wall == upper || body.line[i].wall == lower) ++corners;
  }
  EXPECT_EQ(corners, 2);
  EXPECT_GT(front_of_base, 0.3) << "the columns of the base take most of the turn";
}

TEST(ColumnsOnWall, AFansRaysHaveTheThicknessForTheirLength) {
  const Columned body(test::rhombus_with_layers(four_layers, 0.25));
  int rays = 0;
  for (std::int32_t i = 0; i < body.line.size(); ++i) {
    if (body.line[i].shape == Station::Shape::fan) {
      ++rays;
      EXPECT_EQ(body.columns.length[i], 0.5);
      EXPECT_EQ(body.columns.direction[i], body.line[i].direction);
    }
  }
  EXPECT_GT(rays, 4);
}

TEST(ColumnsOnWall, FittedAgainAreThoseFittedAtOnce) {
  std::mt19937_64 random(7);
  std::vector<Point> coast;
  for (int i = 0; i < 300; ++i) {  // clockwise, rough
    const double angle = -2 * M_PI * i / 300, radius = 5 + 0.2 * static_cast<double>(random() % 100) / 100;
    coast.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const Columned island(
      test::outline_of({{{"sea", {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}}}, {{"coast", coast, four_layers}}}));
  const WallLine& line = island.line;
  ColumnsOnWall again(line);
  std::vector<double> h(line.size(), 0.5);
  for (int pass = 0; pass < 40; ++pass) {
    const WallColumns& fitted = again.fit(h);
    const WallColumns at_once = ColumnsOnWall(line).fit(h);
    ASSERT_EQ(fitted.direction, at_once.direction) << pass;
    ASSERT_EQ(fitted.length, at_once.length) << pass;
    h[random() % h.size()] *= pass < 20 ? 0.8 : 0.5;
    for (int round = 0; round < 2; ++round) {  // slopes
      for (std::int32_t i = 0; i < line.size(); ++i)
        h[line.next(i)] = std::min(h[line.next(i)], h[i] + 0.35 * line.width(i));
      for (std::int32_t i = line.size() - 1; i >= 0; --i)
        h[line.previous(i)] = std::min(h[line.previous(i)], h[i] + 0.35 * line.width(line.previous(i)));
    }
  }
}

}  // namespace
}  // namespace quadloop
