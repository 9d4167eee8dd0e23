// Heights of layers: as asked for, and fitted to a column's length.
#include "mesher/geometry/layer_spec.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop {
namespace {

constexpr LayerSpec usual{1e-5, 1.2, 1.2, 30};

std::vector<double> heights_of(const ColumnHeights& column) {
  std::vector<double> heights;
  for (std::size_t i = 1; i < column.reached.size(); ++i)
    heights.push_back(column.reached[i] - column.reached[i - 1]);
  return heights;
}

TEST(LayerSpec, HeightsGrowFromTheFirstOne) {
  EXPECT_EQ(layer_heights({4, 1.5, 1.5, 4}), (std::vector<double>{4, 6, 9, 13.5}));
  EXPECT_EQ(layers_thickness({4, 1.5, 1.5, 4}), 32.5);
  EXPECT_EQ(layer_heights({3, 1, 1, 3}), (std::vector<double>{3, 3, 3}));
  EXPECT_NEAR(layers_thickness(usual), 1e-5 * (std::pow(1.2, 30) - 1) / 0.2, 1e-15);
}

TEST(LayerSpec, EqualLayersComeFirst) {
  EXPECT_EQ(layer_heights({4, 1.5, 1.5, 4, 2}), (std::vector<double>{4, 4, 6, 9}));
  EXPECT_EQ(layer_heights({4, 1.5, 1.5, 2, 3}), (std::vector<double>{4, 4})) << "more than there are";
}

TEST(LayerSpec, GrowthRisesByATwentiethALayerAfterFive) {
  const std::vector<double> heights = layer_heights({1, 1.1, 1.2, 12});
  const std::vector<double> growths{1.1, 1.1, 1.1, 1.1, 1.1, 1.155, 1.2, 1.2, 1.2, 1.2, 1.2};
  for (std::size_t i = 1; i < heights.size(); ++i)
    EXPECT_NEAR(heights[i] / heights[i - 1], growths[i - 1], 1e-14) << i;
}

TEST(LayerSpec, AsManyLayersAsReachAThickness) {
  const LayerSpec spec{4, 1.5, 1.5, 0};
  EXPECT_EQ(layers_within(spec, 3, 100), 1);
  EXPECT_EQ(layers_within(spec, 19, 100), 3) << "4 + 6 + 9 reach it";
  EXPECT_EQ(layers_within(spec, 19.01, 100), 4);
  EXPECT_EQ(layers_within(spec, 1e9, 7), 7) << "never more than are allowed";
}

TEST(LayerSpec, AColumnOfTheFullLengthIsAsAskedFor) {
  const ColumnHeights column = column_heights(usual, usual.first, layers_thickness(usual));
  ASSERT_EQ(column.reached.size(), 31U);
  EXPECT_EQ(column.reached.front(), 0);
  EXPECT_EQ(column.reached.back(), layers_thickness(usual));
  EXPECT_EQ(column.growth, 1.2);
  const std::vector<double> asked = layer_heights(usual), made = heights_of(column);
  for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_NEAR(made[i], asked[i], 1e-12 * asked[i]) << i;
}

TEST(LayerSpec, AShorterColumnKeepsItsFirstHeightAndGrowsSlower) {
  const ColumnHeights column = column_heights(usual, 1e-5, 0.004);
  EXPECT_NEAR(column.first, 1e-5, 1e-17);
  EXPECT_EQ(column.reached.back(), 0.004);
  EXPECT_LT(column.growth, 1.2);
  EXPECT_NEAR(1e-5 * (std::pow(column.growth, 30) - 1) / (column.growth - 1), 0.004, 1e-14);
  const std::vector<double> heights = heights_of(column);
  for (std::size_t i = 1; i < heights.size(); ++i)
    EXPECT_NEAR(heights[i] / heights[i - 1], column.growth, 1e-9);
}

TEST(LayerSpec, RisingGrowthIsScaledAsAWhole) {
  const LayerSpec rising{1, 1.1, 1.2, 8};
  const std::vector<double> heights = heights_of(column_heights(rising, 1, 10));
  EXPECT_NEAR((heights[7] / heights[6] - 1) / (heights[1] / heights[0] - 1), 2, 1e-9)
      << "excess 0.2 over excess 0.1";
}

TEST(LayerSpec, AColumnTooShortForItsLayersHasEqualOnes) {
  const ColumnHeights column = column_heights({1, 1.2, 1.2, 4}, 1, 2);
  EXPECT_EQ(column.first, 0.5);
  EXPECT_EQ(column.growth, 1);
  EXPECT_EQ(column.reached, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
}

TEST(LayerSpec, InAColumnTooLongTheFirstHeightGivesWayNotTheGrowth) {
  const ColumnHeights column = column_heights({4, 1.5, 1.5, 4}, 4, 65);
  EXPECT_EQ(column.first, 8);
  EXPECT_EQ(column.growth, 1.5);
  EXPECT_EQ(column.reached, (std::vector<double>{0, 8, 20, 38, 65}));
}

TEST(LayerSpec, ColumnsScaleToTheLastBit) {
  const LayerSpec small{1e-5, 1.2, 1.2, 30}, large{1024e-5, 1.2, 1.2, 30};
  const ColumnHeights a = column_heights(small, 1.1e-5, 0.007),
                      b = column_heights(large, 1024 * 1.1e-5, 1024 * 0.007);
  for (std::size_t i = 0; i < a.reached.size(); ++i) EXPECT_EQ(1024 * a.reached[i], b.reached[i]);
}

TEST(LayerSpec, IsAsThickAsALastHeightAllows) {
  const double whole = layers_thickness(usual), last = layer_heights(usual).back();
  EXPECT_EQ(thickness_with_last(usual, last), whole);
  EXPECT_EQ(thickness_with_last(usual, 2 * last), whole);
  for (const double share : {0.7, 0.3, 0.05}) {
    const double thickness = thickness_with_last(usual, share * last);
    EXPECT_LT(thickness, whole);
    const std::vector<double> heights = heights_of(column_heights(usual, usual.first, thickness));
    EXPECT_NEAR(heights.back(), share * last, 1e-6 * last);
    EXPECT_NEAR(heights.front(), usual.first, 1e-9 * usual.first);
  }
  EXPECT_NEAR(thickness_with_last(usual, 0), 30 * usual.first, 1e-12) << "equal layers";
}

TEST(LayerSpec, OfAnotherFirstHeightItIsAsThickAndHasAsManyLayers) {
  const double thickness = layers_thickness(usual);
  for (const double first : {3e-6, 1e-5, 5e-5, 2e-4}) {
    const LayerSpec other = with_first_height(usual, first);
    EXPECT_EQ(other.first, first);
    EXPECT_EQ(other.count, 30);
    EXPECT_NEAR(layers_thickness(other), thickness, 1e-9 * thickness) << first;
    EXPECT_EQ(other.growth > 1.2, first < 1e-5 - 1e-9) << first;
  }
}

TEST(LayerSpec, OfAnotherThicknessItHasTheSameFirstHeightAndNumberOfLayers) {
  const double thickness = layers_thickness(usual);
  for (const double share : {0.7, 1.0, 1.5, 4.0}) {
    const LayerSpec other = with_thickness(usual, 2e-5, share * thickness);
    EXPECT_EQ(other.first, 2e-5);
    EXPECT_EQ(other.count, 30);
    EXPECT_NEAR(layers_thickness(other), share * thickness, 1e-9 * thickness) << share;
  }
}

TEST(LayerSpec, OfAnotherThicknessItsGrowthStaysWithinLimits) {
  EXPECT_NEAR(with_thickness(usual, 1e-5, 1).growth, 1.3, 1e-12);
  EXPECT_NEAR(with_thickness(usual, 1e-5, 0).growth, 1.14, 1e-12);
  const LayerSpec rising{1e-5, 1.2, 1.4, 30}, slow{1e-5, 1.01, 1.01, 30};
  EXPECT_NEAR(with_thickness(rising, 1e-5, 1).growth_to, 1.4, 1e-12) << "as requested at most";
  EXPECT_NEAR(with_thickness(slow, 1e-5, 0).growth, 1.007, 1e-12);
  EXPECT_NEAR(with_thickness(slow, 1e-5, 1).growth, 1.3, 1e-12);
}

TEST(LayerSpec, OfAMuchSmallerFirstHeightItGrowsByHalfAsMuchAgainAtMost) {
  const LayerSpec other = with_first_height({1e-5, 1.2, 1.4, 30}, 1e-8);
  EXPECT_NEAR(other.growth, 1.3, 1e-12);
  EXPECT_NEAR(other.growth_to, 1.6, 1e-12);
  EXPECT_EQ(with_first_height(usual, 1).first, layers_thickness(usual) / 30) << "an equal share at most";
}

}  // namespace
}  // namespace quadloop
