// One column of nodes between the wall and the front.
#include "mesher/layers/layer_column.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::ten_layers;

/// A front with the column at each of its stations.
struct Front {
  explicit Front(Geometry g) : geometry{std::move(g)}, front{layer_front(geometry)} {}
  std::vector<Point> column(const FrontPlace& place, Point node) const {
    return layer_column(front, place, node);
  }
  std::vector<Point> column(std::int32_t station) const { return column({station}, front.points[station]); }
  Geometry geometry;
  LayerFront front;
};

TEST(LayerColumn, OfAStraightWallHasTheHeightsAskedFor) {
  const Front f(test::floor_with_layers(ten_layers));
  const std::vector<Point> nodes = f.column(7);
  ASSERT_EQ(nodes.size(), 10U) << "the front's own node is not among them";
  double height = 0;
  for (std::size_t layer = 0; layer < nodes.size(); ++layer) {
    EXPECT_EQ(nodes[layer].x, f.front.line[7].wall.x);
    EXPECT_NEAR(nodes[layer].y, height, 1e-14);
    height += layer_heights(ten_layers)[layer];
  }
}

TEST(LayerColumn, StandsOnTheWallAtTheShareThatItsNodeHasOfTheFront) {
  const Front f(test::step_with_layers(ten_layers));
  const FrontPlaces places(f.front);
  std::int32_t corner = 0;
  while (f.front.line[corner].wall != Point{4, 0}) ++corner;
  const Point a = f.front.points[corner - 1], b = f.front.points[corner];
  const Point node = a + 0.25 * (b - a);
  const std::vector<Point> nodes = f.column(places.locate(node, BoundaryId{0}), node);
  const Point foot = nodes.front(), first = f.front.line[corner - 1].wall;
  EXPECT_EQ(foot.y, 0) << "on the wall itself";
  EXPECT_NEAR(foot.x, first.x + 0.25 * (4 - first.x), 1e-14);
  for (const Point p : nodes) EXPECT_NEAR(cross(p - foot, node - foot), 0, 1e-14) << "on one line";
}

TEST(LayerColumn, ThatIsTiltedHasItsFirstHeightNormalToTheWall) {
  const Front plain(test::step_with_layers(ten_layers)),
      thinner(test::outline_of(
          {{{"floor", {{0, 0}, {4, 0}, {4, 2}}, ten_layers}, {"rest", {{8, 2}, {8, 6}, {0, 6}}}},
           {{"bar", {{3, 0.8}, {3, 1.2}, {3.4, 1.2}, {3.4, 0.8}}}}}));
  for (const Front* f : {&plain, &thinner}) {
    int columns = 0;
    for (std::int32_t i = 0; i < f->front.line.size(); ++i) {
      if (f->front.line[i].wall.y > 0) continue;
      EXPECT_NEAR(f->column(i)[1].y, 0.02, 1e-14) << f->front.line[i].wall.x;
      ++columns;
    }
    EXPECT_GT(columns, 4);
  }
}

TEST(LayerColumn, InAFanHasTheFirstHeightAlongItself) {
  const Front f(test::rhombus_with_layers(ten_layers, 0.25));
  int rays = 0;
  for (std::int32_t i = 0; i < f.front.line.size(); ++i) {
    if (f.front.line[i].shape == Station::Shape::fan) {
      EXPECT_NEAR(length(f.column(i)[1] - f.front.line[i].wall), 0.02, 1e-14) << i;
      ++rays;
    }
  }
  EXPECT_GT(rays, 4);
}

TEST(LayerColumn, OfReducedLengthKeepsItsCountAndItsFirstHeight) {
  const Front f(test::outline_of({{{"floor", {{0, 0}}, ten_layers}, {"rest", {{8, 0}, {8, 4}, {0, 4}}}},
                                  {{"bar", {{3, 0.9}, {3, 1.5}, {5, 1.5}, {5, 0.9}}}}}));
  for (std::int32_t i = 0; i < f.front.line.size(); ++i) {
    const std::vector<Point> nodes = f.column(i);
    EXPECT_EQ(nodes.size(), 10U);
    EXPECT_NEAR(nodes[1].y, 0.02, 1e-14) << f.front.line[i].wall.x;
  }
}

TEST(LayerColumn, IsTheSameForTheWallWalkedTheOtherWay) {
  const Geometry floor = test::floor_with_layers(ten_layers);
  const Front f(floor), image(test::mirrored(floor));
  const FrontPlaces places(f.front), of_image(image.front);
  for (double x = 1.23; x < 7; x += 0.00171) {
    const Point node{x, layers_thickness(ten_layers)}, mirror{x, -layers_thickness(ten_layers)};
    const std::vector<Point> nodes = f.column(places.locate(node, BoundaryId{0}), node),
                             others = image.column(of_image.locate(mirror, BoundaryId{0}), mirror);
    for (std::size_t layer = 0; layer < nodes.size(); ++layer)
      EXPECT_EQ(nodes[layer], (Point{others[layer].x, -others[layer].y})) << x << ' ' << layer;
  }
}

TEST(LayerColumn, OnACurvedWallIsTheSameForTheWallWalkedTheOtherWay) {
  const Geometry arch = test::arch_and_step_with_layers(ten_layers);
  const Front f(arch), image(test::mirrored(arch));
  const FrontPlaces places(f.front), of_image(image.front);
  int columns = 0;
  for (std::int32_t i = 0; f.front.line[i].segment == 0; ++i) {
    const Point node = f.front.points[i] + 0.3 * (f.front.points[i + 1] - f.front.points[i]);
    const Point mirror{node.x, -node.y};
    const std::vector<Point> nodes = f.column(places.locate(node, BoundaryId{0}), node),
                             others = image.column(of_image.locate(mirror, BoundaryId{0}), mirror);
    for (std::size_t layer = 0; layer < nodes.size(); ++layer)
      EXPECT_EQ(nodes[layer], (Point{others[layer].x, -others[layer].y})) << node.x << ' ' << layer;
    ++columns;
  }
  EXPECT_GT(columns, 20);
}

TEST(LayerColumn, ThatFollowsFrictionChangesEvenlyBetweenStations) {
  LayerSpec wanted = ten_layers;
  wanted.y_plus = 2;
  const Geometry floor = test::floor_with_layers(wanted);
  const LayerFront front = layer_front(floor, {}, {}, {{{{0, 0}, {8, 0}, 60, 140}}, {}, {}});
  const double here = front.line.spec(7).first, next = front.line.spec(8).first;
  EXPECT_GT(here, next * 1.001);
  const Point node = front.points[7] + 0.25 * (front.points[8] - front.points[7]);
  const std::vector<Point> nodes = layer_column(front, {7, 0.25, 0.75}, node);
  ASSERT_EQ(nodes.size(), 10U);
  EXPECT_NEAR(nodes[1].y, here + 0.25 * (next - here), 1e-9);
  EXPECT_NEAR(layer_column(front, {8}, front.points[8])[1].y, next, 1e-9);
}

}  // namespace
}  // namespace quadloop
