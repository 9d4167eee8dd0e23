// Ranks that divide the work on a layer front get the front that a rank alone does.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesher/layers/front/front_tree.hpp"
#include "mesher/layers/front/thickness.hpp"
#include "tests/layers/walls.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

/// Islands of `points` points each within a rough coast: radii vary by up to `roughness` from point to point.
Geometry rough_coasts(int points, double roughness, double thickness) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-roughness, roughness);
  const auto loop = [&](Point centre, double radius, double turns) {
    std::vector<Point> path;
    for (int k = 0; k < points; ++k) {
      const double angle = turns * 2 * M_PI * k / points, r = radius * (1 + noise(random));
      path.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
    }
    return path;
  };
  const LayerSpec layers = test::equal_layers(thickness, 5);
  return test::outline_of({{{"coast", loop({0, 0}, 10, 1), layers}},
                           {{"island", loop({4, 0}, 2, -1), layers}},
                           {{"atoll", loop({-4, 1}, 1.5, -1), layers}}});
}

/// Columns at several thicknesses, one after the other.
std::vector<WallColumns> columns_of(const WallLine& line, const Communicator* sharing) {
  ColumnsOnWall columns(line, sharing);
  std::vector<WallColumns> found;
  std::vector<double> h;
  for (std::int32_t i = 0; i < line.size(); ++i) h.push_back(line.asked(i));
  for (const double share : {1.0, 0.7, 0.3, 0.6}) {
    std::vector<double> thickness = h;
    for (double& one : thickness) one *= share;
    found.push_back(columns.fit(thickness));
  }
  return found;
}

TEST(SharedFront, ColumnsOfRoughCoastsAreThoseOfARankAlone) {
  for (const double thickness : {0.05, 0.2, 1.0}) {
    const Geometry geometry = rough_coasts(300, 0.02, thickness);
    const WallLine line(geometry, wall_runs(geometry));
    const std::vector<WallColumns> alone = columns_of(line, nullptr),
                                   shared = columns_of(line, &test::world());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(shared[k].direction, alone[k].direction) << thickness;
      EXPECT_EQ(shared[k].length, alone[k].length) << thickness;
    }
  }
}

TEST(SharedFront, ThicknessesOfRoughCoastsAreThoseOfARankAlone) {
  for (const double thickness : {0.1, 0.5}) {
    const Geometry geometry = rough_coasts(200, 0.02, thickness);
    const WallLine line(geometry, wall_runs(geometry));
    const FittingColumns alone = fit_thickness(line), shared = fit_thickness(line, {}, &test::world());
    EXPECT_EQ(shared.thickness, alone.thickness);
    EXPECT_EQ(shared.columns.direction, alone.columns.direction);
    EXPECT_EQ(shared.front, alone.front);
  }
}

TEST(FrontTree, FindsTheSegmentsThatMeetABox) {
  const Geometry geometry = rough_coasts(40, 0.02, 0.1);
  const WallLine line(geometry, wall_runs(geometry));
  const auto segment = [&](std::int32_t i) -> std::optional<Segment> {
    if (i % 3 == 0 || !line.goes_on(i)) return std::nullopt;
    return Segment{line[i].wall, line[line.next(i)].wall};
  };
  const FrontTree tree(line, segment);
  for (const Point at : {Point{10, 0}, Point{4, 2}, Point{-4, 2.5}, Point{0, 0}}) {
    const Box box{at - Point{0.5, 0.5}, at + Point{0.5, 0.5}};
    std::vector<std::int32_t> found, expected;
    tree.for_each_meeting(box, [&](std::int32_t i) { found.push_back(i); });
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (const auto s = segment(i); s && box_of(s->from, s->to).meets(box)) expected.push_back(i);
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(expected.empty(), at == (Point{0, 0}));
  }
}

}  // namespace
}  // namespace quadloop
