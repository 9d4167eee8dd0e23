// Wakes that follow the flow keep clear of what is beside and before them.
#include "mesher/layers/front/wake_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/layers/layer_report.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

/// A box round a body with a sharp edge at (2, 0), and another one behind it, whose left end is at (x, y).
Geometry two_bodies(double x, double y, const std::optional<LayerSpec>& of_second) {
  return test::outline_of(
      {{{"box", {{-8, -8}, {12, -8}, {12, 8}, {-8, 8}}}},
       {{"body", {{-1, 0.1}, {2, 0}, {-1, -0.1}}, test::equal_layers(0.2, 4)}},
       {{"second", {{x, y}, {x + 1, y + 0.3}, {x + 2, y}, {x + 1, y - 0.3}}, of_second}}});
}

LayerLine wake_of_flow() {
  LayerLine wake;
  wake.from = {"body"};
  wake.at = Point{2, 0};
  wake.length = 6;
  wake.spacing = 0.2;
  wake.where = "case.toml:9";
  wake.follows_flow = true;
  return wake;
}

/// The smallest distance of a strip's front from the points of a boundary.
double distance_from(const LayerStrip& strip, const Geometry& g, const std::string& boundary) {
  double least = 1e9;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (g.boundary(g.boundary_of(v)).name != boundary) continue;
    for (std::size_t k = 1; k < strip.front.size(); ++k)
      least =
          std::min(least, place_on_segment(g.point(v), strip.front[k - 1], strip.front[k]).squared_distance);
  }
  return std::sqrt(least);
}

TEST(WakeRoom, AWakeEndsBeforeAnotherBody) {
  for (const auto& layers : {std::optional<LayerSpec>{}, std::optional(test::equal_layers(0.2, 4))}) {
    const Geometry g = two_bodies(5, 0.1, layers);
    LayerLine wake = wake_of_flow();
    const LayerFront front = layer_front(g, {}, {wake});
    const LayerStrip& strip = front.strips[0];
    ASSERT_TRUE(strip.shortened);
    EXPECT_EQ(strip.shortened->before, "boundary second");
    EXPECT_EQ(strip.shortened->requested, 6);
    EXPECT_LT(strip.shortened->left, layers ? 2.85 : 3);
    EXPECT_GT(strip.shortened->left, layers ? 2.5 : 2.7);
    EXPECT_GT(distance_from(strip, front.outer, "second"), 0.04);
    const std::vector<std::string> warnings = size_warnings(front, 0.001);
    EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
      return warning.starts_with("case.toml:9: wake ends at (4.") &&
             warning.find("as it comes near boundary second; reduce") != std::string::npos;
    }));
    wake.follows_flow = false;
    EXPECT_THROW(layer_front(g, {}, {wake}), std::exception) << "a wake with a course of its own stays";
  }
}

TEST(WakeRoom, AWakeBecomesThinnerBesideAnotherBody) {
  const Geometry g = two_bodies(4, 0.75, {});
  const LayerFront front = layer_front(g, {}, {wake_of_flow()});
  const LayerStrip& strip = front.strips[0];
  EXPECT_FALSE(strip.shortened);
  EXPECT_GT(distance_from(strip, front.outer, "second"), 0.15);
  const auto thickness_near = [&](double x) {
    const auto column = std::ranges::min_element(
        strip.columns, {}, [&](const std::vector<Point>& c) { return std::abs(c[c.size() / 2].x - x); });
    return length(column->back() - (*column)[column->size() / 2]);
  };
  EXPECT_LE(thickness_near(5), 0.4 * std::hypot(0.45, 0.1) + 1e-9)
      << "0.45 below the lowest point, half a column from it";
  EXPECT_GT(thickness_near(5), 0.15);
  EXPECT_GT(thickness_near(7.5), 0.3) << "past the body it thickens again";
}

TEST(WakeRoom, TheLayersOfAWallBesideAWakeLeaveItRoom) {
  // without layers the second body leaves a free distance of 0.45 to the wake
  const Geometry g = two_bodies(4, 0.75, test::equal_layers(0.4, 4));
  const LayerFront front = layer_front(g, {}, {wake_of_flow()});
  const LayerStrip& strip = front.strips[0];
  EXPECT_FALSE(strip.shortened);
  double thinnest = 1, whole = 0;
  for (std::int32_t i = 0; i < front.line.size(); ++i) {
    const Station& station = front.line[i];
    if (g.boundary(station.layers).name != "second") continue;
    const double distance = station.wall.y;  // from the wake on the x axis
    if (station.direction.y < 0) {
      EXPECT_LE(front.thickness[i], 0.36 * distance + 1e-9) << station.wall.x;
    }
    thinnest = std::min(thinnest, front.thickness[i]);
    whole = std::max(whole, front.thickness[i]);
  }
  EXPECT_GT(thinnest, 0.3 * 0.45) << "where the body is next to the wake";
  EXPECT_DOUBLE_EQ(whole, 0.4) << "on its other side";
  for (const std::vector<Point>& column : strip.columns)
    EXPECT_GT(length(column.back() - column[column.size() / 2]), 0.05);
}

TEST(WakeRoom, AWakeThatKeepsItsCourseHasNoLimits) {
  const Geometry g = two_bodies(4, 3, {});
  LayerLine wake = wake_of_flow();
  const LayerStrip followed = layer_front(g, {}, {wake}).strips[0];
  wake.follows_flow = false;
  const LayerStrip fixed = layer_front(g, {}, {wake}).strips[0];
  EXPECT_FALSE(followed.shortened);
  EXPECT_EQ(followed.front, fixed.front) << "with room enough both are the same";
}

/// A line that begins at no wall has no edge: a sanitized program ends if it is looked up.
TEST(WakeRoom, ALineInTheFlowBesideAWakeKeepsItsLength) {
  const Geometry g = two_bodies(4, 3, {});
  LayerLine line;
  line.path = {{4, -3}, {6, -3}};
  line.spacing = 0.2;
  line.layers = test::equal_layers(0.2, 4);
  const std::vector<LayerStrip> beside = layer_front(g, {}, {wake_of_flow(), line}).strips;
  ASSERT_EQ(beside.size(), 2U);
  EXPECT_FALSE(beside[1].shortened);
  EXPECT_EQ(beside[1].front, layer_front(g, {}, {line}).strips[0].front);
}

}  // namespace
}  // namespace quadloop
