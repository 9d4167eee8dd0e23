// First heights that follow the friction along the wall.
#include "mesher/layers/front/followed_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/layers/front/layer_front.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

/// An estimate of 0.02 for y+ = 2; 0.519 thick.
const LayerSpec target_layers{0.02, 1.2, 1.2, 10, 1, 2};
const double target_thickness = layers_thickness(target_layers);

/// The floor from x = 0 to 8 in so many edges, with wall units that depend on x.
template <class WallUnits>
MeasuredWall measured_floor(int edges, const WallUnits& wall_units) {
  MeasuredWall wall;
  for (int k = 0; k < edges; ++k) {
    const double from = 8.0 * k / edges, to = 8.0 * (k + 1) / edges;
    wall.push_back({{from, 0}, {to, 0}, wall_units(from), wall_units(to)});
  }
  return wall;
}

struct Followed {
  Followed(Geometry g, const MeasuredFlow& flow)
      : geometry{std::move(g)}, line{geometry, wall_runs(geometry)}, layers{followed_layers(line, flow)} {}
  Followed(Geometry g, const MeasuredWall& wall) : Followed(std::move(g), MeasuredFlow{wall, {}, {}}) {}
  Geometry geometry;
  WallLine line;
  std::vector<LayerSpec> layers;
};

TEST(FollowedLayers, TheFirstHeightHasTheYPlusAndThicknessAndCountStay) {
  const Followed f(test::floor_with_layers(target_layers),
                   measured_floor(1, [](double x) { return 100 + 7.5 * x; }));
  for (std::int32_t i = 0; i < f.line.size(); ++i) {
    const LayerSpec& layers = f.layers[i];
    EXPECT_NEAR(layers.first, 2 / (100 + 7.5 * f.line[i].wall.x), 1e-15);
    EXPECT_EQ(layers.count, 10);
    EXPECT_NEAR(layers_thickness(layers), target_thickness, 1e-9) << f.line[i].wall.x;
  }
}

TEST(FollowedLayers, HeightsStayWithinATenthAndTenTimesOfTheEstimate) {
  const Followed thin(test::floor_with_layers(target_layers), measured_floor(4, [](double) { return 1e9; }));
  const Followed thick(test::floor_with_layers(target_layers), measured_floor(4, [](double) { return 0.0; }));
  for (const LayerSpec& layers : thin.layers) {
    EXPECT_DOUBLE_EQ(layers.first, 0.002);
    EXPECT_NEAR(layers.growth, 1.3, 1e-9) << "no more than half as much again";
    EXPECT_LT(layers_thickness(layers), target_thickness);
  }
  for (const LayerSpec& layers : thick.layers) {
    EXPECT_NEAR(layers.first, target_thickness / 10, 1e-12) << "less than ten times, as the others need room";
    EXPECT_NEAR(layers_thickness(layers), target_thickness, 1e-12);
  }
}

TEST(FollowedLayers, HeightsGrowSlowlyTowardsAPlaceWithoutFriction) {
  const Followed f(test::floor_with_layers(target_layers),
                   measured_floor(64, [](double x) { return 200 * std::abs(x - 4); }));
  double largest = 0;
  for (std::int32_t i = 0; f.line.next(i) != WallLine::none; ++i) {
    const double here = f.layers[i].first, next = f.layers[f.line.next(i)].first;
    const double most = 1 + 0.6 * f.line.width(i) / target_thickness;
    EXPECT_LE(next, here * most * (1 + 1e-12));
    EXPECT_LE(here, next * most * (1 + 1e-12));
    EXPECT_LE(here, 2 / (200 * std::abs(f.line[i].wall.x - 4)) * (1 + 1e-12)) << "y+ is never more";
    largest = std::max(largest, here);
  }
  EXPECT_NEAR(f.layers[0].first, 2.0 / 800, 1e-15) << "far from there y+ is met";
  EXPECT_LT(largest, target_thickness / 10) << "there it is not the bound that holds";
}

TEST(FollowedLayers, BoundariesOfAGivenHeightAndWhatIsNotMeasuredKeepTheirs) {
  LayerSpec given = target_layers;
  given.y_plus = 0;
  const Followed fixed(test::floor_with_layers(given), measured_floor(4, [](double) { return 1000.0; }));
  for (const LayerSpec& layers : fixed.layers) EXPECT_EQ(layers, given);
  const MeasuredWall backwards{{{8, 0}, {0, 0}, 1000, 1000}};
  const Followed unknown(test::floor_with_layers(target_layers), backwards);
  for (const LayerSpec& layers : unknown.layers) EXPECT_EQ(layers.first, target_layers.first);
}

/// 1.2 times as thick as the boundary layer.
TEST(FollowedLayers, TheThicknessIsThatOfTheFlowWithTheFirstHeightOfItsFriction) {
  LayerSpec layers = target_layers;
  layers.follows_flow = true;
  MeasuredFlow flow;
  flow.thickness = {{{0, 0}, {4, 0}, 0.36, 0.344}, {{4, 0}, {8, 0}, 0.344, 0.328}};
  for (const bool has_friction : {false, true}) {
    if (has_friction) flow.walls = measured_floor(1, [](double x) { return 100 + 7.5 * x; });
    const Followed f(test::floor_with_layers(layers), flow);
    for (std::int32_t i = 0; i < f.line.size(); ++i) {
      const double x = f.line[i].wall.x, first = has_friction ? 2 / (100 + 7.5 * x) : 0.02;
      EXPECT_NEAR(f.layers[i].first, first, 1e-15);
      EXPECT_EQ(f.layers[i].count, 10);
      EXPECT_NEAR(layers_thickness(f.layers[i]), 1.2 * (0.36 - 0.004 * x), 1e-9) << x;
    }
  }
}

/// Beside large cells they are thicker than the boundary layer.
TEST(FollowedLayers, TheLastLayerIsAtLeastAsHighAsTheCellsThatAdaptationRequests) {
  LayerSpec layers = target_layers;
  layers.follows_flow = true;
  const Geometry floor = test::floor_with_layers(layers);
  const WallLine line(floor, wall_runs(floor));
  MeasuredFlow flow;
  flow.thickness = {{{0, 0}, {8, 0}, 0.36, 0.36}};
  const auto last_layers = [&](const AdaptedSize& cells) {
    std::vector<double> last;
    for (const LayerSpec& found : followed_layers(line, flow, cells)) {
      EXPECT_EQ(found.first, layers.first);
      EXPECT_GE(layers_thickness(found), 1.2 * 0.36 - 1e-9);
      last.push_back(layer_heights(found).back());
    }
    return last;
  };
  const std::vector<double> of_flow = last_layers({});
  EXPECT_EQ(last_layers([](Point, Point, double most) { return std::min(most, 0.05); }), of_flow);
  const double own = layer_heights(layers).back();
  for (const double size : last_layers([](Point, Point, double most) { return std::min(most, 0.09); }))
    EXPECT_NEAR(size, 0.09, 1e-9);
  for (const double size : last_layers([](Point, Point, double most) { return most; }))
    EXPECT_NEAR(size, own, 1e-9) << "not thicker than the boundary's own layers";
  const auto growing = [](Point a, Point b, double most) { return std::min(most, 0.3 * std::min(a.y, b.y)); };
  for (const LayerSpec& found : followed_layers(line, flow, growing)) {
    const double fit = 0.3 * 0.8 * layers_thickness(found);
    EXPECT_NEAR(layer_heights(found).back(), std::min(fit, own), 0.02 * fit);
  }
}

TEST(FollowedLayers, TheThicknessStaysWithinATenthAndTenTimesOfTheEstimateAndTheGrowthInItsLimits) {
  LayerSpec layers = target_layers;
  layers.follows_flow = true;
  MeasuredFlow thin, thick, unknown;
  thin.thickness = {{{0, 0}, {8, 0}, 1e-9, 1e-9}};
  thick.thickness = {{{0, 0}, {8, 0}, 100, 100}};
  unknown.thickness = {{{0, 0}, {8, 0}, 0, 0}};
  for (const LayerSpec& found : Followed(test::floor_with_layers(layers), thin).layers)
    EXPECT_NEAR(found.growth, 1 + 0.7 * (layers.growth - 1), 1e-12);
  for (const LayerSpec& found : Followed(test::floor_with_layers(layers), thick).layers)
    EXPECT_NEAR(found.growth, 1.3, 1e-12);
  for (const LayerSpec& found : Followed(test::floor_with_layers(layers), unknown).layers)
    EXPECT_EQ(found, layers);
  for (const LayerSpec& found : Followed(test::floor_with_layers(target_layers), thick).layers)
    EXPECT_NEAR(layers_thickness(found), target_thickness, 1e-9) << "does not follow the flow";
}

TEST(FollowedLayers, EachSideOfAThinBodyFollowsItsOwnFriction) {
  // of an earlier mesh, whose lower side lies nearer to the upper one of this body than its own upper side
  const MeasuredWall wall{{{-2, 1e-3}, {2, 1e-3}, 100, 100}, {{2, 0}, {-2, 0}, 150, 150}};
  const Followed f(test::rhombus_with_layers(target_layers, 1e-4), wall);
  int above = 0, below = 0;
  for (std::int32_t i = 0; i < f.line.size(); ++i) {
    const Point place = f.line[i].wall;
    if (std::abs(place.x) > 1) continue;  // at the edges both sides meet
    EXPECT_DOUBLE_EQ(f.layers[i].first, place.y > 0 ? 0.02 : 2.0 / 150) << place.x;
    ++(place.y > 0 ? above : below);
  }
  EXPECT_GT(above, 0);
  EXPECT_GT(below, 0);
}

TEST(FollowedLayers, MirrorImagesHaveMirroredHeights) {
  MeasuredWall wall = measured_floor(13, [](double x) { return 100 + 300 * std::abs(std::sin(x)); }), other;
  const Geometry floor = test::floor_with_layers(target_layers);
  for (const MeasuredEdge& e : wall)
    other.push_back({{e.to.x, -e.to.y}, {e.from.x, -e.from.y}, e.wall_units_to, e.wall_units_from});
  const Followed one(floor, wall), image(test::mirrored(floor), other);
  ASSERT_EQ(one.line.size(), image.line.size());
  for (std::int32_t i = 0; i < one.line.size(); ++i)
    EXPECT_EQ(one.layers[i], image.layers[one.line.size() - 1 - i]) << i;
}

TEST(FollowedLayers, TheFrontsLastLayersAskForLeavesOfTheirSize) {
  const Geometry floor = test::floor_with_layers(target_layers);
  const MeasuredWall wall = measured_floor(1, [](double x) { return 100 + 7.5 * x; });
  const LayerFront front = layer_front(floor, {}, {}, {wall, {}, {}});
  const auto last_layer = [&](std::int32_t i) {
    const std::vector<double> heights =
        column_heights(front.line.spec(i), 2 / (100 + 7.5 * front.line[i].wall.x), target_thickness).reached;
    return heights.back() - heights[heights.size() - 2];
  };
  double first = 0, last = 0;
  std::int32_t edges = 0;
  for (std::int32_t i = 0; i < front.line.size(); ++i) {
    EXPECT_EQ(front.thickness[i], front.line.asked(i));
    const std::int32_t next = front.line.next(i);
    if (next == WallLine::none) continue;
    last = std::min(leaf_over_last_layer * std::min(last_layer(i), last_layer(next)), floor.spacing_of(0));
    if (edges++ == 0) first = last;
    EXPECT_NEAR(front.outer.spacing_of(i), last, 1e-9 * last) << front.line[i].wall.x;
  }
  EXPECT_EQ(edges, front.line.size() - 1);
  EXPECT_GT(last, 1.05 * first) << "thinner first layers grow faster, so that the last ones are higher";
}

}  // namespace
}  // namespace quadloop
