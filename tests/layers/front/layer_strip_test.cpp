// The columns across a wake or a free line, and the front round them.
#include "mesher/layers/front/layer_strip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

const LayerSpec line_layers{0.01, 1.3, 1.3, 8};

PlacedLine straight(double length, double spacing) {
  return {PlacedLine::nowhere, PlacedLine::nowhere, {{0, 0}, {length, 0}}, spacing, line_layers};
}

LayerStrip sharp_wake() {
  PlacedLine line = straight(6, 0.1);
  line.edge = line.base_end = 0;
  const double h = layers_thickness(line_layers);
  return layer_strip(line, WakeRoot{0, {0.02, h}, {0.02, -h}, {}, 0.04});
}

double row_height(const LayerStrip& strip, std::size_t column, std::size_t row) {
  return length(strip.columns[column][row + 1] - strip.columns[column][row]);
}

void expect_positive(const LayerStrip& strip) {
  for (std::size_t k = 0; k + 1 < strip.columns.size(); ++k) {
    const std::vector<Point>&a = strip.columns[k], &b = strip.columns[k + 1];
    for (std::size_t r = 0; r + 1 < a.size(); ++r) {
      const std::array quad{a[r], b[r], b[r + 1], a[r + 1]};
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_GT(orientation(quad[c], quad[(c + 1) % 4], quad[(c + 2) % 4]), 0)
            << "column " << k << ", row " << r;
    }
  }
}

/// A wake of thin layers along the x-axis, beside cells of size 0.01 at x = 3 if they are adapted.
LayerStrip wake_beside_cells(double least, double growth) {
  const LayerSpec thin{0.0005, 1.2, 1.2, 8};
  const double h = layers_thickness(thin);
  const PlacedLine line{0, 0, {{0, 0}, {6, 0}}, 0.1, thin};
  const AdaptedSize adapted = [&](Point a, Point b, double most) {
    return std::min(most, least + growth * std::abs(0.5 * (a.x + b.x) - 3));
  };
  return layer_strip(line, WakeRoot{0, {0.0005, h}, {0.0005, -h}, {}, 0.004}, adapted);
}

TEST(LayerStrip, ColumnsAreAsWideAsAdaptedCellsBesideThem) {
  const LayerStrip strip = wake_beside_cells(0.01, 0.5);
  expect_positive(strip);
  const std::size_t middle = strip.columns[0].size() / 2;
  double before = 0, least = 1, at = 0;
  for (std::size_t k = 0; k + 1 < strip.columns.size(); ++k) {
    const double x = strip.columns[k][middle].x, width = strip.columns[k + 1][middle].x - x;
    if (width < least && x > 2) least = width, at = x;
    if (before > 0) {
      EXPECT_LT(std::max(width / before, before / width), 1.25) << x;
    }
    EXPECT_LT(width, 1.3 * (0.01 + 0.5 * std::abs(x - 3))) << x;
    if (x > 2) {
      EXPECT_LT(row_height(strip, k, 0), 0.75 * width + 0.02 * std::abs(x - 3)) << x;
    }
    if (x > 1.2 && x < 1.8) {
      EXPECT_GT(width, 0.09) << "far from there, at " << x;
    }
    before = width;
  }
  EXPECT_NEAR(at, 3, 0.05);
  EXPECT_GT(least, 0.009);
}

TEST(LayerStrip, LargerCellsBesideItChangeNothing) {
  const LayerStrip coarse = wake_beside_cells(0.2, 0), other = wake_beside_cells(0.3, 0.1);
  EXPECT_EQ(coarse.columns, other.columns);
  EXPECT_EQ(coarse.front, other.front);
  const LayerSpec thin = coarse.spec;
  EXPECT_EQ(coarse.columns, layer_strip({0, 0, {{0, 0}, {6, 0}}, 0.1, thin}, coarse.root).columns);
}

TEST(LayerStrip, AWakeBeginsWithTheWallsColumnsAndOpens) {
  const LayerStrip strip = sharp_wake();
  expect_positive(strip);
  const auto rows = static_cast<std::size_t>(2 * line_layers.count), middle = rows / 2;
  for (const auto& column : strip.columns) ASSERT_EQ(column.size(), rows + 1);
  EXPECT_EQ(strip.columns[0].back(), strip.root->left);
  EXPECT_EQ(strip.columns[0].front(), strip.root->right);
  EXPECT_NEAR(row_height(strip, 0, middle), line_layers.first, 1e-2 * line_layers.first)
      << "its column leans";
  for (std::size_t k = 0; k + 1 < strip.columns.size(); ++k) {
    const double ratio = row_height(strip, k + 1, middle) / row_height(strip, k, middle);
    EXPECT_GT(ratio, 0.95) << k;
    EXPECT_LT(ratio, 1.25) << k;
  }
  const std::size_t last = strip.columns.size() - 1;
  const double width = strip.columns[last][middle].x - strip.columns[last - 1][middle].x;
  for (std::size_t r = 0; r < rows; ++r) {
    EXPECT_GT(row_height(strip, last, r), 0.4 * width);
    EXPECT_LT(row_height(strip, last, r), 1.5 * width);
  }
  EXPECT_EQ(strip.columns[last][middle], (Point{6, 0}));
}

TEST(LayerStrip, BothSidesAreMirrored) {
  const LayerStrip strip = sharp_wake();
  for (const auto& column : strip.columns) {
    for (std::size_t r = 0; r < column.size(); ++r) {
      const Point p = column[r], q = column[column.size() - 1 - r];
      EXPECT_EQ(p.x, q.x);
      EXPECT_EQ(p.y, -q.y);
    }
  }
}

/// Of a row of a wake along x; its nodes round the layers on a base stand aslant.
double height_across(const LayerStrip& strip, std::size_t column, std::size_t row) {
  return strip.columns[column][row + 1].y - strip.columns[column][row].y;
}

TEST(LayerStrip, ABaseIsDividedAsFinelyAsTheLayersBesideIt) {
  PlacedLine line = straight(6, 0.1);
  line.edge = 0;
  line.base_end = 1;
  const double h = layers_thickness(line_layers), half = 0.1;
  const LayerStrip strip =
      layer_strip(line, WakeRoot{0, {0, half + h}, {0, -half - h}, {{0, half}, {0, -half}}, 0.04});
  expect_positive(strip);
  EXPECT_EQ(strip.core % 2, 0);
  EXPECT_EQ(strip.columns[0].size(), static_cast<std::size_t>(2 * line_layers.count + strip.core + 1));
  EXPECT_EQ(strip.columns[0][line_layers.count], (Point{0, -half}));
  EXPECT_EQ(strip.columns[0][line_layers.count + strip.core], (Point{0, half}));
  for (int row = line_layers.count - 1; row < line_layers.count + strip.core; ++row) {
    const double ratio = height_across(strip, 0, row + 1) / height_across(strip, 0, row);
    EXPECT_LT(std::max(ratio, 1 / ratio), 1.35) << row;
  }
}

/// A wake behind a base from one foot to the other, in the direction of x.
LayerStrip wake_behind(const std::vector<Point>& base) {
  PlacedLine line = straight(6, 0.1);
  line.path[0] = 0.5 * (base.front() + base.back());
  line.edge = 0;
  line.base_end = size32(base) - 1;
  const double h = layers_thickness(line_layers);
  return layer_strip(line, WakeRoot{0, base.front() + Point{0, h}, base.back() - Point{0, h}, base, 0.04});
}

TEST(LayerStrip, TheBaseHasLayersOfTheHeightsAskedFor) {
  const std::vector<std::vector<Point>> bases{
      {{0, 0.1}, {0, -0.1}}, {{-0.02, 0.1}, {0.02, -0.1}}, {{0, 0.1}, {0.02, 0}, {0, -0.1}}};
  for (const std::vector<Point>& base : bases) {
    const LayerStrip strip = wake_behind(base);
    ASSERT_GE(strip.base_layers(), base == bases[0] ? 2 : 1);
    const std::size_t edges = strip.core - 2 * strip.base_layers();
    ASSERT_GE(edges, 2U);
    for (const std::vector<Point>& line : strip.base_lines) ASSERT_EQ(line.size(), edges + 1);
    const auto middle = strip.columns[0].begin() + line_layers.count + strip.base_layers();
    const std::vector<Point> behind(middle, middle + edges + 1);
    const std::vector<Point>& second = strip.base_layers() > 1 ? strip.base_lines[1] : behind;
    for (std::size_t i = 1; i < edges; ++i) {
      double nearest = 1;  // of the base's segments
      for (std::size_t k = 0; k + 1 < base.size(); ++k)
        nearest =
            std::min(nearest, std::sqrt(place_on_segment(second[i], base[k], base[k + 1]).squared_distance));
      EXPECT_NEAR(nearest, line_layers.first, 0.03 * line_layers.first);
    }
    expect_positive(strip);
  }
}

TEST(LayerStrip, ABaseThinnerThanALayerHasNone) {
  const LayerStrip strip = wake_behind({{0, 0.004}, {0, -0.004}});
  EXPECT_EQ(strip.base_layers(), 0);
  for (int row = line_layers.count; row <= line_layers.count + strip.core; ++row)
    EXPECT_EQ(strip.columns[0][row].x, 0) << "on the base";
}

TEST(LayerStrip, AFreeLineIsFineAlongItAndCoarseAtBothEnds) {
  const LayerStrip strip = layer_strip(straight(4, 0.1), {});
  expect_positive(strip);
  const std::size_t middle = line_layers.count, half = strip.columns.size() / 2;
  EXPECT_NEAR(row_height(strip, half, middle), line_layers.first, 1e-9);
  const double even = layers_thickness(line_layers) / line_layers.count;
  EXPECT_NEAR(row_height(strip, 0, middle), even, 1e-9);
  EXPECT_NEAR(row_height(strip, strip.columns.size() - 1, middle), even, 1e-9);
  EXPECT_NEAR(strip.columns[half + 1][middle].x - strip.columns[half][middle].x, 0.1, 0.01);
}

/// Half of the sum of cross products; negative where points go round clockwise.
double area_round(const std::vector<Point>& points) {
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    area += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
  return area;
}

TEST(LayerStrip, ALineAcrossAnAxisIsItsOwnImageToTheLastBit) {
  PlacedLine line = straight(0, 0.1);
  line.path = {{2.3, -1.1}, {2.1, -0.3}, {2.1, 0.3}, {2.3, 1.1}};
  line.across = MirrorAxis::x;
  const LayerStrip strip = layer_strip(line, {});
  expect_positive(strip);
  const std::size_t last = strip.columns.size() - 1, points = strip.front.size();
  ASSERT_EQ(last % 2, 0U);
  ASSERT_EQ(points, 2 * (last + 1) + 4);
  for (std::size_t k = 0; k <= last; ++k) {
    for (std::size_t r = 0; r < strip.columns[k].size(); ++r)
      EXPECT_EQ(strip.columns[k][r], image_of(MirrorAxis::x, strip.columns[last - k][r])) << k << " " << r;
  }
  for (const Point p : strip.columns[last / 2]) EXPECT_EQ(p.y, 0);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t image = (last + points - i) % points;
    EXPECT_EQ(strip.front[i], image_of(MirrorAxis::x, strip.front[image])) << i;
    EXPECT_EQ(strip.spacing[i], strip.spacing[(image + points - 1) % points]) << i;
  }
  EXPECT_EQ(std::ranges::count(strip.front, 0.0, &Point::y), 2);
}

TEST(LayerStrip, TheFrontGoesRoundItWithTheDomainToItsLeft) {
  const LayerStrip free = layer_strip(straight(4, 0.1), {});
  EXPECT_LT(area_round(free.front), -4 * 2 * layers_thickness(line_layers));
  EXPECT_EQ(free.spacing.size(), free.front.size());
  const LayerStrip wake = sharp_wake();
  EXPECT_EQ(wake.spacing.size(), wake.front.size() + 1);
  EXPECT_EQ(wake.front[wake.corners[0]].x, wake.front[wake.corners[1]].x);
  EXPECT_GT(wake.front[wake.corners[0]].y, wake.front[wake.corners[1]].y);
  std::vector<Point> closed = wake.front;
  closed.push_back(wake.root->right);
  closed.push_back(wake.root->left);
  EXPECT_LT(area_round(closed), 0);
}

TEST(LayerStrip, ABentPathHasColumnsAcrossIt) {
  PlacedLine line = straight(4, 0.05);
  line.path = {{0, 0}, {2, 0}, {3.5, 1}};
  const LayerStrip strip = layer_strip(line, {});
  expect_positive(strip);
}

TEST(LayerStrip, APathThatReturnsToItsFirstPointWithinItsLayersIsRefused) {
  PlacedLine line = straight(4, 0.05);
  line.name = "layer_line";
  line.path = {{0, 0}, {0.2, 0.1}, {0, 0}};
  line.layers.first = 0.05;
  const std::string message = test::refusal([&] { layer_strip(line, {}); });
  EXPECT_EQ(message.find("layer_line returns to its first point (0, 0) within"), 0) << message;
}

}  // namespace
}  // namespace quadloop
