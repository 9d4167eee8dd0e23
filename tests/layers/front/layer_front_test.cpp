// The outline of the domain outside the layers, and what it asks of the mesh there.
#include "mesher/layers/front/layer_front.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::ten_layers;

TEST(LayerFront, StandsInTheWallsPlace) {
  const Geometry floor = test::floor_with_layers(ten_layers);
  const LayerFront front = layer_front(floor);
  const double thickness = layers_thickness(ten_layers);
  EXPECT_NEAR(test::loop_area(front.outer, 0), 8 * (4 - thickness), 1e-12);
  ASSERT_EQ(std::ssize(front.station_of), front.outer.size());
  std::int32_t of_front = 0;
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    const bool is_front = front.station_of[s] != WallLine::none;
    of_front += is_front ? 1 : 0;
    EXPECT_EQ(front.outer.boundary(front.outer.boundary_of(s)).name, is_front ? "floor" : "rest");
    if (!is_front) continue;
    EXPECT_EQ(front.outer.point(s), front.points[front.station_of[s]]);
    EXPECT_NEAR(front.outer.point(s).y, thickness, 1e-15);
  }
  EXPECT_EQ(of_front, front.line.size() - 1);
  EXPECT_EQ(front.outer.size(), of_front + 4 - 1) << "the sides that it ends on begin above the wall";
}

TEST(LayerFront, LeavesAreAsHighAsTwoOfTheLastLayers) {
  const Geometry geometry = test::floor_with_layers(ten_layers);
  const LayerFront front = layer_front(geometry);
  const std::vector<double> heights = layer_heights(ten_layers);
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    if (front.station_of[s] != WallLine::none) {
      EXPECT_NEAR(front.outer.spacing_of(s), 2 * heights.back(), 1e-12);
    } else {
      EXPECT_EQ(front.outer.spacing_of(s), 0.25) << "sides without layers ask for what they did";
    }
  }
}

TEST(LayerFront, TheWallsOwnSpacingHoldsOnItsFrontToo) {
  const Geometry fine =
      test::outline_of({{{"floor", {{0, 0}}, ten_layers}, {"rest", {{8, 0}, {8, 4}, {0, 4}}}}}, 0.0625);
  const LayerFront front = layer_front(fine);
  for (std::int32_t s = 0; s < front.outer.size(); ++s)
    EXPECT_LE(front.outer.spacing_of(s), 0.0625 * (1 + 1e-12));
}

TEST(LayerFront, TheWallsTurnsAskForSmallerLeavesWhereCurvatureIsARule) {
  std::vector<Point> circle;
  for (int k = 0; k < 40; ++k) {
    const double angle = -std::acos(-1.0) * k / 20;
    circle.push_back({std::cos(angle), std::sin(angle)});
  }
  LayerSpec thin = ten_layers;
  thin.first = 0.005;
  const Geometry body =
      test::outline_of({{{"box", {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}}}, {{"body", circle, thin}}}, 1);
  const LayerFront loose = layer_front(body), strict = layer_front(body, 1.0);
  const double on_wall = 2 * std::sin(std::acos(-1.0) / 40) / 9;  // a degree of nine, of a side
  double most = 0;
  for (std::int32_t s = 0; s < strict.outer.size(); ++s) {
    if (strict.station_of[s] == WallLine::none) continue;
    most = std::max(most, strict.outer.spacing_of(s));
    EXPECT_GE(strict.outer.spacing_of(s), on_wall * (1 - 1e-9));
    EXPECT_GT(loose.outer.spacing_of(s), 2 * strict.outer.spacing_of(s));
    EXPECT_EQ(strict.outer.bend_degrees(s), 0) << "the front's own turns do not count";
    EXPECT_GT(strict.last_heights[s], 0);
  }
  EXPECT_GT(most, 1.1 * on_wall) << "columns are wider on the front, where they spread";
  EXPECT_LT(most, 1.5 * on_wall);
}

TEST(LayerFront, KeptPlacesOfTheWallAreKeptOnTheFront) {
  const Geometry geometry = test::step_with_layers(ten_layers);
  const LayerFront front = layer_front(geometry);
  std::vector<Point> kept;
  for (std::int32_t v = 0; v < front.outer.size(); ++v) {
    if (front.outer.kept(v)) kept.push_back(front.outer.point(v));
  }
  ASSERT_EQ(kept.size(), 6U) << "two corners, two ends, two corners of the box";
  const double h = layers_thickness(ten_layers);
  EXPECT_NEAR(kept[0].x, 0, 1e-15);
  EXPECT_NEAR(kept[1].x, 4 - h, 1e-12) << "the concave corner";
  EXPECT_NEAR(kept[1].y, h, 1e-12);
  EXPECT_LT(kept[2].x, 4) << "the convex one";
  EXPECT_GT(kept[2].y, 2);
}

TEST(LayerFront, InAFanSectorsAreNotTooSharp) {
  const LayerSpec low_ones = test::equal_layers(0.5, 20);  // two of the last layers are 0.05 high
  const Geometry geometry = test::rhombus_with_layers(low_ones, 0.25);
  const LayerFront front = layer_front(geometry);
  std::int32_t in_fans = 0;
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    const std::int32_t i = front.station_of[s];
    if (i == WallLine::none || front.line.width(i) > 0) continue;
    ++in_fans;
    EXPECT_NEAR(front.outer.spacing_of(s), 0.3 * 0.5, 1e-12);
  }
  EXPECT_EQ(in_fans, 32);
}

TEST(LayerFront, MirrorImagesHaveMirroredFronts) {
  const Geometry body =
      test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                        {{"body", {{-2, 0.1}, {-0.7, 0.6}, {0.4, 0.3}, {2, 0}, {0.3, -0.4}}, ten_layers}},
                        {{"flap", {{2.2, 0.3}, {3.3, -0.4}, {2.4, -0.2}}, ten_layers}}});
  const Geometry other = test::mirrored(body);
  const LayerFront front = layer_front(body), image = layer_front(other);
  std::vector<Point> points = front.points, mirrored;
  for (const Point p : image.points) mirrored.push_back({p.x, -p.y});
  std::ranges::sort(points);
  std::ranges::sort(mirrored);
  EXPECT_EQ(points, mirrored) << "bit for bit";
  EXPECT_TRUE(std::ranges::any_of(front.thickness, [](double h) { return h < layers_thickness(ten_layers); }))
      << "the gap behind the body is narrow";
}

TEST(LayerFront, OnACurvedWallIsMirroredToo) {
  LayerSpec thick = ten_layers;
  thick.first = 0.06;
  const Geometry arch = test::arch_and_step_with_layers(thick), other = test::mirrored(arch);
  const LayerFront front = layer_front(arch), image = layer_front(other);
  std::vector<Point> points = front.points, mirrored;
  for (const Point p : image.points) mirrored.push_back({p.x, -p.y});
  std::ranges::sort(points);
  std::ranges::sort(mirrored);
  EXPECT_EQ(points, mirrored) << "also where columns lean and spread";
}

TEST(LayerFront, OfASymmetricBodyIsSymmetric) {
  for (const double half_base : {0.3, 0.1, 0.03, 0.01}) {
    const Geometry body =
        test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                          {{"body", {{-2, 0}, {2, half_base}, {2, -half_base}}, ten_layers}}});
    const LayerFront front = layer_front(body);
    std::vector<Point> points = front.points, mirrored;
    for (const Point p : points) mirrored.push_back({p.x, 0.0 - p.y});
    std::ranges::sort(points);
    std::ranges::sort(mirrored);
    EXPECT_EQ(points, mirrored) << half_base;
  }
}

/// The side on which a floor's last column lies has points of its own below the column's end.
/// A free line with thin layers of its own; the third in its case file.
LayerLine line_at(std::vector<Point> path) {
  LayerLine line;
  line.path = std::move(path);
  line.spacing = 0.05;
  line.layers = test::equal_layers(0.02, 2);
  line.where = "case.toml:9";
  return line;
}

TEST(LayerFront, NoLineLiesWithinTheLayersOfAnotherThing) {
  const Geometry body =
      test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                        {{"body", {{-2, 0}, {0, 1}, {2, 0}, {0, -1}}, test::equal_layers(1, 4)}}});
  const LayerLine outside = line_at({{-4, 4}, {-3, 4}}), in_layers = line_at({{-0.2, 1.4}, {0.2, 1.4}});
  LayerLine thick = line_at({{-5, 5}, {-2, 5}});
  thick.layers = test::equal_layers(1, 4);
  const LayerLine in_thick = line_at({{-4, 5.4}, {-3, 5.4}});
  LayerLine wake;
  wake.from = {"body"};
  wake.length = 3;
  wake.spacing = 0.2;
  const Geometry sharp =
      test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                        {{"body", {{-2, 0}, {-1, 1}, {2, 0}, {-1, -1}}, test::equal_layers(0.5, 4)}}});
  const LayerLine in_wake = line_at({{3, 0.2}, {3.5, 0.2}});
  const auto said = [](const Geometry& g, const std::vector<LayerLine>& lines) {
    return test::refusal([&] { layer_front(g, {}, lines); });
  };
  const auto expect_within = [&](const std::string& message, const std::string& what,
                                 const std::string& whose) {
    EXPECT_EQ(message.find("case.toml:9: " + what + " lies within the layers of " + whose + ", at ("), 0U)
        << message;
  };
  EXPECT_EQ(layer_front(body, {}, {outside}).strips.size(), 1U);
  expect_within(said(body, {in_layers}), "layer_line", "boundary body");
  expect_within(said(body, {outside, in_layers}), "layer_line_2", "boundary body");
  expect_within(said(body, {thick, in_thick}), "layer_line_2", "layer_line_1");
  expect_within(said(body, {in_thick, thick}), "layer_line_1", "layer_line_2");
  expect_within(said(sharp, {wake, in_wake}), "layer_line", "wake");
  EXPECT_NE(said(body, {line_at({{-0.2, 0}, {0.2, 0}})}).find("layer_line lies outside of the domain, at ("),
            std::string::npos);
  EXPECT_NE(said(body, {line_at({{9, 0}, {10, 0}})}).find("layer_line lies outside of the domain, at ("),
            std::string::npos);
}

TEST(LayerFront, NoLineGoesRoundABody) {
  const Geometry mote = test::outline_of(
      {{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}}, {{"mote", {{0, 0}, {0, 0.1}, {0.1, 0}}}}});
  LayerLine thick = line_at({{-2, 0}, {2, 0}});
  thick.layers = test::equal_layers(1, 4);
  const std::string message = test::refusal([&] { layer_front(mote, {}, {thick}); });
  EXPECT_EQ(message.find("case.toml:9: the layers of layer_line cover boundary mote at ("), 0U) << message;
}

TEST(LayerFront, TheLastColumnTakesThePlaceOfPointsOnTheBoundaryBelowIt) {
  const double thickness = layers_thickness(ten_layers);
  std::vector<Point> rest{{8, 0}, {8, 4}, {0, 4}};
  for (double y = 3.9; y > 0.05; y -= 0.1) rest.push_back({0, y});
  const LayerFront front = layer_front(test::outline_of({{{"floor", {{0, 0}}, ten_layers}, {"rest", rest}}}));
  EXPECT_NEAR(test::loop_area(front.outer, 0), 8 * (4 - thickness), 1e-12);
  for (const Point p : front.outer.points()) EXPECT_GE(p.y, thickness - 1e-12);
}

TEST(LayerFront, LayersAreNoThickerAtAnEndThanTheBoundaryThereIsStraight) {
  const Geometry g = test::outline_of(
      {{{"floor", {{0, 0}}, ten_layers}, {"rest", {{8, 0}, {8, 4}, {-0.5, 4}, {-0.5, 0.4}, {0, 0.2}}}}});
  const LayerFront front = layer_front(g);
  EXPECT_NEAR(front.thickness[0], 0.18, 1e-12);
  EXPECT_NEAR(front.thickness[front.line.size() - 1], layers_thickness(ten_layers), 1e-12);
}

/// A body that is straight up to its sharp edge (4, 0), whose outline has `points` points on either side with
/// nine decimals; their distances from the edge grow as squares.
Geometry wedge_of(int points, double camber) {
  const auto decimals = [](double length) { return std::round(1e9 * length) / 1e9; };
  std::vector<Point> upper, lower;
  for (int k = 1; k < points; ++k) {
    const double share = std::pow(k / static_cast<double>(points), 2), x = decimals(4 - 4 * share);
    upper.push_back({x, decimals((camber + 0.6) * share)});
    lower.push_back({x, decimals((camber - 0.6) * share)});
  }
  std::vector<Point> body(upper.rbegin(), upper.rend());
  body.push_back({4, 0});
  body.insert(body.end(), lower.begin(), lower.end());
  return test::outline_of(
      {{{"box", {{-8, -8}, {16, -8}, {16, 8}, {-8, 8}}}}, {{"body", body, test::equal_layers(0.5, 4)}}});
}

TEST(LayerFront, LayersAtAWakeDoNotDependOnTheDensityOfTheOutline) {
  LayerLine wake;
  wake.from = {"body"};
  wake.spacing = 0.2;
  for (const int points : {10, 100, 400}) {
    for (const double camber : {0.0, 0.8}) {
      const Geometry geometry = wedge_of(points, camber);
      for (const double bend : {0.0, 0.3}) {
        wake.path = {{5, bend - camber / 4}, {7, bend - camber / 2}};
        const LayerFront front = layer_front(geometry, {}, {wake});
        const auto which = fmt::format("{} points, camber {}, bend {}", points, camber, bend);
        EXPECT_EQ(*std::ranges::min_element(front.thickness), 0.5) << which;
        for (std::int32_t i = 0; i < front.line.size(); ++i) {
          if (front.line[i].wall.x < 2 || !front.line.goes_on(i)) continue;
          const double ahead = length(front.points[front.line.next(i)] - front.points[i]);
          EXPECT_LT(ahead, 2 * front.line.width(i)) << which << ": a step at " << front.line[i].wall.x;
        }
      }
    }
  }
}

/// The segments of the outer geometry by their ends, from left to right, with the sizes that they request;
/// as mirror images in the x-axis if `mirrored`.
std::map<std::pair<Point, Point>, double> sizes_of(const Geometry& outer, bool mirrored) {
  std::map<std::pair<Point, Point>, double> sizes;
  for (std::int32_t s = 0; s < outer.size(); ++s) {
    Point a = outer.point(s), b = outer.point(outer.next(s));
    if (mirrored) a = image_of(MirrorAxis::x, a), b = image_of(MirrorAxis::x, b);
    sizes[std::minmax(a, b)] = outer.spacing_of(s);
  }
  return sizes;
}

TEST(LayerFront, AsksForMirroredSizesRoundASymmetricBodyWithAWakeOnItsAxis) {
  std::vector<Point> above, body;
  for (int k = 0; k <= 12; ++k) {
    const double x = 0.5 * (1 + std::cos(std::acos(-1.0) * k / 12));
    above.push_back({x, k == 0 || k == 12 ? 0 : 0.3 * std::sqrt(x) * (1 - x)});
  }
  for (std::size_t k = 0; k < above.size(); ++k) body.push_back(image_of(MirrorAxis::x, above[k]));
  for (std::size_t k = above.size() - 2; k > 0; --k) body.push_back(above[k]);
  LayerSpec spec = ten_layers;
  spec.first = 0.01;
  const Geometry geometry =
      test::outline_of({{{"box", {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}}}, {{"body", body, spec}}}, 0.06);
  LayerLine wake;
  wake.from = {"body"};
  wake.length = 1;
  wake.spacing = 0.1;
  const LayerFront front = layer_front(geometry, {}, {wake}, {}, true);
  EXPECT_EQ(sizes_of(front.outer, false), sizes_of(front.outer, true));
  const LayerFront loose = layer_front(geometry, {}, {wake}, {}, false);
  EXPECT_NE(sizes_of(loose.outer, false), sizes_of(loose.outer, true)) << "a front that shows the difference";
}

}  // namespace
}  // namespace quadloop
