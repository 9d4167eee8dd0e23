// How thick layers may be: as asked for where there is room, and less in gaps and notches.
#include "mesher/layers/front/thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/geometry/predicates.hpp"
#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::four_layers;

struct Fitted {
  explicit Fitted(Geometry g)
      : geometry{std::move(g)}, line(geometry, wall_runs(geometry)), fitting{fit_thickness(line)} {}
  Geometry geometry;
  WallLine line;
  FittingColumns fitting;
};

/// A box of 16 by 16 round two bars of layers, `gap` apart from x = 0 to 4.
Geometry two_bars(double gap) {
  return test::outline_of({{{"box", {{-6, -8}, {10, -8}, {10, 8}, {-6, 8}}}},
                           {{"lower", {{0, -2}, {0, 0}, {4, 0}, {4, -2}}, four_layers}},
                           {{"upper", {{0, gap}, {0, 2 + gap}, {4, 2 + gap}, {4, gap}}, four_layers}}});
}

/// A floor with a notch.
Geometry notch(double half_width, double depth) {
  return test::outline_of(
      {{{"floor", {{0, 0}, {4 - half_width, 0}, {4, -depth}, {4 + half_width, 0}}, four_layers},
        {"rest", {{8, 0}, {8, 4}, {0, 4}}}}});
}

TEST(FitThickness, IsAsAskedWhereThereIsRoom) {
  for (const Geometry& g : {test::floor_with_layers(four_layers), test::step_with_layers(four_layers),
                            test::rhombus_with_layers(four_layers, 0.25), two_bars(3)}) {
    const Fitted f(g);
    for (const double h : f.fitting.thickness) EXPECT_EQ(h, 0.5);
  }
}

TEST(FitThickness, LayersThickerThanAChannelStayWithinIt) {
  for (const double asked : {1.87, 5.6, 20.0, 400.0}) {
    const Fitted f(test::outline_of(
        {{{"floor", {{0, 0}}, test::equal_layers(asked, 20)}, {"rest", {{4, 0}, {4, 1}, {0, 1}}}}}));
    for (std::int32_t i = 0; i < f.line.size(); ++i) {
      EXPECT_LT(f.fitting.front[i].y, 1) << asked << " at " << f.line[i].wall.x;
      EXPECT_GT(f.fitting.front[i].y, 0.2);
    }
  }
}

TEST(FitThickness, ABodyBetweenTwoColumnsStaysOutsideTheLayers) {
  // So thick are the layers asked for that the box has columns at its corners alone.
  const auto body_in_box = [](std::vector<test::Side> body) {
    return test::outline_of(
        {{{"box", {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, test::equal_layers(400, 20)}}, std::move(body)}, 1);
  };
  const std::vector<Point> small{{0.8, 0.3}, {0.75, 0.35}, {0.7, 0.3}, {0.75, 0.25}};
  for (const Geometry& g : {body_in_box({{"body", small}}), body_in_box({{"body", small, four_layers}})}) {
    const Fitted f(g);
    std::int32_t after = 0;
    for (std::int32_t i = 0; i < f.line.size(); ++i) {
      if (f.geometry.boundary_of(f.line[i].segment) != BoundaryId{0}) continue;
      ++after;
      EXPECT_GT(cross(f.fitting.front[f.line.next(i)] - f.fitting.front[i], small[0] - f.fitting.front[i]), 0)
          << "the front goes round the body, after station " << i;
    }
    EXPECT_EQ(after, 4);
  }
}

TEST(FitThickness, WallsThatFaceEachOtherShareTheirGap) {
  const double gap = 0.6;
  const Fitted f(two_bars(gap));
  double least = 1;
  for (std::int32_t i = 0; i < f.line.size(); ++i) {
    const Point wall = f.line[i].wall;
    const double h = f.fitting.thickness[i];
    least = std::min(least, h);
    if ((wall.y == 0 || wall.y == gap) && 1 < wall.x && wall.x < 3) {
      EXPECT_NEAR(h, 0.36 * gap, 1e-9) << wall.x;
    }
    if (wall.y == -2 || wall.y == 2 + gap) {
      EXPECT_EQ(h, 0.5) << "behind, all is as asked";
    }
  }
  EXPECT_GT(least, 0.2 * gap);
}

TEST(FitThickness, FrontsThatPassEachOtherKeepRoomForCellsToo) {
  // The needle's tip is over the floor; columns of the floor beside it meet none of its walls, but its front.
  const double gap = 0.9;
  const Fitted f(test::outline_of({{{"floor", {{0, 0}}, four_layers}, {"rest", {{8, 0}, {8, 4}, {0, 4}}}},
                                   {{"needle", {{4, gap}, {3.8, 3}, {4.2, 3}}, four_layers}}}));
  double least = 1;
  for (std::int32_t i = 0; i < f.line.size(); ++i) {
    for (std::int32_t j = 0; j < f.line.size(); ++j) {
      if (f.line[i].wall.y == 0 && f.line[j].wall.y > 0)
        least = std::min(least, length(f.fitting.front[i] - f.fitting.front[j]));
    }
  }
  EXPECT_GT(least, 0.25 * gap);
}

TEST(FitThickness, KeepsAwayFromBoundariesWithoutLayers) {
  const Fitted f(test::outline_of({{{"floor", {{0, 0}}, four_layers}, {"rest", {{8, 0}, {8, 4}, {0, 4}}}},
                                   {{"bar", {{3, 0.5}, {3, 1}, {5, 1}, {5, 0.5}}}}}));
  int below = 0, beside = 0;
  for (std::int32_t i = 0; i < f.line.size(); ++i) {
    const double x = f.line[i].wall.x;
    if (3 <= x && x <= 5) {
      EXPECT_LT(f.fitting.thickness[i], 0.3) << x;
      ++below;
    }
    if (x < 1 || x > 7) {
      EXPECT_EQ(f.fitting.thickness[i], 0.5) << x;
      ++beside;
    }
  }
  EXPECT_GT(below, 0);
  EXPECT_GT(beside, 0);
}

TEST(FitThickness, ChangesByAtMostAThirdOfTheWay) {
  for (const double gap : {0.1, 0.3, 0.6, 1.0}) {
    const Fitted f(two_bars(gap));
    for (std::int32_t i = 0; i < f.line.size(); ++i) {
      EXPECT_LE(f.fitting.thickness[i], 0.5);
      const double change = std::abs(f.fitting.thickness[f.line.next(i)] - f.fitting.thickness[i]);
      EXPECT_LE(change, 0.35 * f.line.width(i) * (1 + 1e-12)) << i;
    }
  }
}

TEST(FitThickness, StripsArePositiveAndFrontsMeetNothing) {
  for (const Geometry& g :
       {two_bars(0.1), test::rhombus_with_layers(test::equal_layers(3, 4), 0.25),
        test::step_with_layers(test::equal_layers(1.8, 4)), notch(0.3, 1), notch(0.3, 3), notch(0.1, 1)}) {
    const Fitted f(g);
    const auto& front = f.fitting.front;
    int strips = 0;
    for (std::int32_t i = 0; i < f.line.size(); ++i) {
      const std::int32_t j = f.line.next(i);
      if (j == WallLine::none) continue;
      ++strips;
      const Point a = f.line[i].wall, b = f.line[j].wall;
      EXPECT_GT(orientation(b, front[j], front[i]), 0) << i;
      if (a != b) {
        EXPECT_GT(orientation(a, b, front[j]), 0) << i;
      }
      for (std::int32_t k = 0; k < f.line.size(); ++k) {
        const std::int32_t l = f.line.next(k);
        if (l == WallLine::none || k == i || k == j || l == i) continue;
        EXPECT_FALSE(segments_meet(front[i], front[j], front[k], front[l])) << i << ' ' << k;
      }
    }
    EXPECT_GT(strips, 3);
  }
}

}  // namespace
}  // namespace quadloop
