// The boundary on which the last column of a wall lies: straight, or along a curve.
#include "mesher/layers/front/end_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/layers/front/layer_front.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

constexpr double radius = 4;

/// A floor of a length of 4 with layers between two parts of circles around (0, 0) and (4, 0) of radius 4,
/// which bulge out of the domain at its right end and into it at its left end.
Geometry floor_between_arcs(int pieces = 4) {
  constexpr double angle = 0.125;  // of a piece, in radians
  GeometryBuilder builder;
  const Curve arc_out{{}, {1, std::cos(angle / 2), 1}, 0};
  const auto at = [](double phi, double centre) {
    return Point{centre + radius * std::cos(phi), radius * std::sin(phi)};
  };
  const auto add_arc = [&](double from, double step, double centre, BoundaryId boundary) {
    for (int k = 0; k < pieces; ++k) {
      const double phi = from + k * step;
      Curve curve = arc_out;
      const Point direction{std::cos(phi + step / 2), std::sin(phi + step / 2)};
      curve.inner = {Point{centre, 0} + (radius / std::cos(step / 2)) * direction};
      builder.add(at(phi, centre), boundary, curve);
    }
  };
  builder.add({0, 0}, BoundaryId{0});
  add_arc(0, angle, 0, BoundaryId{1});
  builder.add(at(pieces * angle, 0), BoundaryId{2});
  add_arc(pieces * angle, -angle, -4, BoundaryId{3});
  builder.end_loop();
  return std::move(builder).geometry(
      std::vector<Boundary>{{.name = "floor", .spacing = 0.25, .layers = test::four_layers},
                            {.name = "right", .spacing = 0.25},
                            {.name = "top", .spacing = 0.25},
                            {.name = "left", .spacing = 0.25}});
}

double distance_from_arc(Point p, bool right) {
  return std::abs(length(p - Point{right ? 0.0 : -4.0, 0}) - radius);
}

TEST(EndPath, FollowsACurveUpToATurnOf30Degrees) {
  const Geometry g = floor_between_arcs();
  for (const bool first : {false, true}) {
    const EndPath path(g, first ? 0 : 1, first);
    EXPECT_TRUE(path.is_curved());
    EXPECT_EQ(path.pieces().size(), 4U);  // 28.6 degrees
    EXPECT_NEAR(path.length(), 4 * 2 * radius * std::sin(0.0625), 1e-14);
    EXPECT_NEAR(path.direction().y, 1, 1e-15);
    EXPECT_EQ(path.point_at(0), g.point(first ? 0 : 1));
    for (int k = 1; k < 32; ++k) {
      const double distance = path.length() * k / 32;
      EXPECT_LT(distance_from_arc(path.point_at(distance), !first), 1e-14);
      EXPECT_NEAR(path.point_at(distance).y, radius * std::sin(0.5 * k / 32), 1e-3);
    }
  }
}

TEST(EndPath, EndsWhereACurveTurnsByMore) {
  const Geometry g = floor_between_arcs(7);
  for (const bool first : {false, true}) {
    const EndPath path(g, first ? 0 : 1, first);
    EXPECT_EQ(path.pieces().size(), 4U);  // a fifth one would reach 35.8 degrees
  }
}

TEST(EndPath, EndsAtAKeptPointOfACurve) {
  for (const double corner : {10.0, 30.0}) {  // degrees
    GeometryBuilder builder;
    builder.add({0, 0}, BoundaryId{0});
    builder.add({4, 0}, BoundaryId{1}, {{{4, 0.5}}, {}, 0});
    builder.add({4.05, 1}, BoundaryId{1}, {{{4.25, 1.5}}, {}, 0});  // turns by 16 degrees
    builder.add({4.4, 2}, BoundaryId{2});
    builder.add({0, 2}, BoundaryId{2});
    builder.end_loop();
    const Geometry g = std::move(builder).geometry(
        std::vector<Boundary>{{.name = "floor", .spacing = 0.25, .layers = test::four_layers},
                              {.name = "right", .spacing = 0.25, .corner_degrees = corner},
                              {.name = "rest", .spacing = 0.25}});
    EXPECT_EQ(EndPath(g, 1, false).pieces().size(), corner == 10 ? 1U : 2U);
  }
}

TEST(EndPath, StraightPartsEndAtTheFirstTurn) {
  const Geometry g = test::step_with_layers(test::four_layers);
  const EndPath path(g, 0, true);
  EXPECT_FALSE(path.is_curved());
  EXPECT_EQ(path.pieces().size(), 1U);
  EXPECT_EQ(path.length(), 6);
}

TEST(EndPath, TheFrontEndsOnTheCurveAndItsRestIsKept) {
  const Geometry g = floor_between_arcs();
  const LayerFront front = layer_front(g);
  const std::int32_t last = front.line.size() - 1;
  EXPECT_LT(distance_from_arc(front.points[0], false), 1e-14);
  EXPECT_LT(distance_from_arc(front.points[last], true), 1e-14);
  EXPECT_NEAR(front.points[0].y, 0.5, 0.05);
  int curved = 0;
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    const std::string& name = front.outer.boundary(front.outer.boundary_of(s)).name;
    EXPECT_EQ(front.outer.is_curved(s), name == "left" || name == "right") << s;
    if (!front.outer.is_curved(s)) continue;
    ++curved;
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      EXPECT_LT(distance_from_arc(point_at(front.outer.segment(s), t), name == "right"), 2e-14);
  }
  EXPECT_EQ(curved, 6) << "of four pieces on either side; the last columns end on the second ones";
}

}  // namespace
}  // namespace quadloop
