// Layers become thinner where adaptation requests cells lower than their last layer.
#include "mesher/layers/front/adapted_thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/layers/front/layer_front.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::ten_layers;

constexpr double smallest_spacing = 0.03;

/// Cells of size 0.03 above x = 4, growing by half of the distance from there.
double size_beside(Point a, Point b, double most) {
  return std::min(most, smallest_spacing + 0.5 * std::abs(0.5 * (a.x + b.x) - 4));
}

double last_layer(const LayerFront& front, std::int32_t i) {
  const ColumnHeights column = column_heights(ten_layers, ten_layers.first, front.thickness[i]);
  return column.reached.back() - column.reached[ten_layers.count - 1];
}

TEST(AdaptedThickness, TheLastLayerIsAsHighAsTheCellsOutside) {
  const Geometry floor = test::floor_with_layers(ten_layers);
  const LayerFront front = layer_front(floor, {}, {}, {}, false, {}, size_beside);
  double lowest = 1;
  for (std::int32_t i = 0; i < front.line.size(); ++i) {
    const Point foot = front.line[i].wall;
    EXPECT_LT(last_layer(front, i), 1.41 * size_beside(foot, foot, 1)) << foot.x;
    EXPECT_EQ(front.thickness[i], front.line.asked(i)) << "which is no lack of room";
    if (foot.x < 2 || foot.x > 6) {
      EXPECT_EQ(front.thickness[i], layers_thickness(ten_layers)) << foot.x;
    }
    lowest = std::min(lowest, last_layer(front, i));
    if (i > 0) {
      EXPECT_LE(std::abs(front.thickness[i] - front.thickness[i - 1]), 0.3501 * front.line.width(i - 1));
    }
  }
  EXPECT_GT(lowest, 1.2 * smallest_spacing);
}

TEST(AdaptedThickness, LargerCellsChangeNothing) {
  const Geometry floor = test::floor_with_layers(ten_layers);
  const auto coarse = [](Point, Point, double most) { return std::min(most, 0.1); };
  EXPECT_EQ(layer_front(floor, {}, {}, {}, false, {}, coarse).points, layer_front(floor).points);
}

/// Layers that follow the flow may cover small cells in the boundary layer: only those at the front count.
TEST(AdaptedThickness, OfLayersThatFollowTheFlowOnlyCellsAtTheFrontCount) {
  LayerSpec layers = ten_layers;
  layers.follows_flow = true;
  const double thickness = layers_thickness(layers);
  const Geometry floor = test::floor_with_layers(layers), fixed = test::floor_with_layers(ten_layers);
  for (const double small_below : {0.5, 0.9, 1.1}) {
    const auto cells = [&](Point a, Point b, double most) {
      return std::min(a.y, b.y) < small_below * thickness ? std::min(most, smallest_spacing) : most;
    };
    const LayerFront front = layer_front(floor, {}, {}, {}, false, {}, cells);
    const double fit = thickness_with_last(layers, 1.4 * smallest_spacing);
    ASSERT_LT(fit, 0.99 * thickness);
    for (std::int32_t i = 0; i < front.line.size(); ++i)
      EXPECT_NEAR(front.thickness[i], small_below < 0.8 ? thickness : fit, 1e-9) << small_below;
    const LayerFront of_fixed = layer_front(fixed, {}, {}, {}, false, {}, cells);
    EXPECT_NEAR(of_fixed.thickness[of_fixed.line.size() / 2], fit, 1e-9);
  }
}

}  // namespace
}  // namespace quadloop
