// Curves are subdivided until decisions on chords hold for them, and stay the same curves.
#include "mesher/geometry/assemble/subdivide_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/facets.hpp"

namespace quadloop {
namespace {

Chain circle(Point centre, double radius, const std::string& name = "circle") {
  Chain chain{name, true, {centre + Point{radius, 0}}, "drawing.dxf: " + name};
  append_arc(chain, {centre, {radius, 0}, {0, radius}, 0, 2 * std::numbers::pi}, chain.points.front());
  chain.points.pop_back();
  chain.open = false;
  return chain;
}

Chain box() { return {"box", false, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, "box"}; }

Geometry curved_geometry(std::vector<Chain> chains, const AssembleOptions& options = {}) {
  Warnings warnings;
  return assemble(std::move(chains), options, warnings);
}

std::string refusal_of_curves(std::vector<Chain> chains) {
  try {
    curved_geometry(std::move(chains));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SubdivideCurves, ACircleIsFollowedByChords) {
  AssembleOptions options;
  options.chord_height = 1e-4;
  const Geometry g = curved_geometry({box(), circle({1, 2}, 0.5)}, options);
  ASSERT_TRUE(g.has_curves());
  int curved = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (!g.is_curved(s)) continue;
    ++curved;
    EXPECT_NEAR(length(g.point(s) - Point{1, 2}), 0.5, 1e-15);
    EXPECT_LE(height_of_hull(g.segment(s)), 1e-4);
    EXPECT_NEAR(length(g.on_curve(s, 0.5 * (g.point(s) + g.point(g.next(s)))) - Point{1, 2}), 0.5, 1e-15);
    // A smooth curve has no corners, and chords request the cells of the curve.
    EXPECT_FALSE(g.kept(s));
    EXPECT_NEAR(g.turn_degrees(s), 0, 1e-6);
    const double degrees_of_cell = 360 * std::asin(g.spacing_of(s)) / std::numbers::pi;
    EXPECT_NEAR(degrees_of_cell, 11.25, 1.1);  // at most 15, halved from 90
  }
  EXPECT_EQ(curved, 256);  // of 1.5 degrees: halved from 90 until the control points are within 1e-4
  EXPECT_TRUE(facets_of(g).empty());
}

TEST(SubdivideCurves, BoundarySpacingAndLayersLimitTheHeight) {
  AssembleOptions options;
  options.rules.resize(1);
  options.rules[0].pattern = "circle";
  options.rules[0].spacing = 0.002;
  const auto coarsest = [&](const Geometry& g) {
    double height = 0;
    for (std::int32_t s = 0; s < g.size(); ++s) height = std::max(height, height_of_hull(g.segment(s)));
    return height;
  };
  EXPECT_LE(coarsest(curved_geometry({box(), circle({0, 0}, 1)}, options)), 0.002 / 32);
  LayerSpec& layers = options.rules[0].layers.emplace();
  layers.first = 1e-5;
  layers.growth = layers.growth_to = 1.2;
  layers.count = 10;
  EXPECT_LE(coarsest(curved_geometry({box(), circle({0, 0}, 1)}, options)),
            layers_thickness(*options.rules[0].layers) / 500);
}

TEST(SubdivideCurves, CirclesCloseTogetherAreSeparated) {
  // The chords of a coarse subdivision would cross.
  const Geometry g = curved_geometry({box(), circle({0, 0}, 1, "a"), circle({2 + 1e-6, 0}, 1, "b")});
  EXPECT_EQ(g.loop_count(), 3);
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (!g.is_curved(s)) continue;
    const double from_a = length(g.point(s)), from_b = length(g.point(s) - Point{2 + 1e-6, 0});
    EXPECT_LT(std::min(std::abs(from_a - 1), std::abs(from_b - 1)), 1e-15);
  }
}

TEST(SubdivideCurves, ANestedCircleInsideItsNeighboursChordStaysOutside) {
  // Concentric circles whose chords, at 15 degrees, would cross.
  const Geometry g = curved_geometry({circle({0, 0}, 1, "outer"), circle({0, 0}, 0.9999, "inner")});
  EXPECT_EQ(g.loop_count(), 2);
}

TEST(SubdivideCurves, TouchingCurvesAreRefusedWithAPlace) {
  EXPECT_NE(
      refusal_of_curves({box(), circle({0, 0.1}, 1, "a"), circle({1.5, 0.3}, 0.7, "b")}).find("'a' and 'b'"),
      std::string::npos);
}

TEST(SubdivideCurves, CurvesThatRunAlongEachOtherAreRefused) {
  const auto arc = [](double begin, double end) {
    const EllipticArc on_circle{{0, 0}, {1, 0}, {0, 1}, begin, end};
    Chain chain{"rim", true, {on_circle.point_at(begin)}, "drawing.dxf: rim"};
    append_arc(chain, on_circle);
    return chain;
  };
  for (const std::vector<Chain>& twice :
       {std::vector{circle({0, 0}, 1), arc(0, 3), arc(3, 2 * std::numbers::pi)},
        {arc(0, 3), arc(1, 4), arc(4, 2 * std::numbers::pi)}}) {
    const std::string said = refusal_of_curves(twice);
    EXPECT_NE(said.find("run along each other at ("), std::string::npos) << said;
  }
  const std::string equal = refusal_of_curves({circle({0, 0}, 1), circle({0, 0}, 1, "rim")});
  for (const char* const part : {"'circle'", "'rim'", "at (1, 0)", "overlap = \"union\""})
    EXPECT_NE(equal.find(part), std::string::npos) << equal;
}

TEST(SubdivideCurves, ASplineThatWouldCrossItselfIsStraightThere) {
  // The last points of a thin trailing edge: the spline through the lower ones swings through the upper side.
  Chain foil{"foil",
             false,
             {{1, 0},
              {0.9961, 0.0},
              {0.985, -0.0022},
              {0.9677, -0.0057},
              {0.8, -0.03},
              {0.4, -0.05},
              {0.05, -0.03},
              {0, 0},
              {0.05, 0.03},
              {0.4, 0.05},
              {0.8, 0.03},
              {0.9676, 0.0033},
              {0.985, 0.0012},
              {0.9961, 0.0002}},
             "foil.dat"};
  join_by_splines(foil, 30);
  Warnings warnings;
  const Geometry g = assemble({box(), foil}, {}, warnings);
  int straight = 0, curved = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.boundary(g.boundary_of(s)).name == "foil") (g.is_curved(s) ? curved : straight) += 1;
  }
  EXPECT_GT(straight, 0);
  EXPECT_LE(straight, 4);
  EXPECT_GT(curved, 50);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("joined by straight lines there"), std::string::npos) << warnings[0];
}

TEST(SubdivideCurves, CurvesJoinInEitherDirection) {
  Chain top{"top", true, {{1, 0}}, "f:1"}, bottom{"bottom", true, {{1, 0}}, "f:2"};
  append_bulge(top, 1, {-1, 0});
  append_bulge(bottom, -1, {-1, 0});  // traversed backwards in the loop
  const Geometry g = curved_geometry({box(), top, bottom});
  int curved = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (!g.is_curved(s)) continue;
    ++curved;
    const Point p = g.on_curve(s, 0.5 * (g.point(s) + g.point(g.next(s))));
    EXPECT_NEAR(length(p), 1, 1e-15);
    EXPECT_EQ(g.boundary(g.boundary_of(s)).name, p.y > 0 ? "top" : "bottom");
  }
  EXPECT_GE(curved, 48);
}

TEST(SubdivideCurves, TheDigestTellsCurvesFromChords) {
  const Geometry g = curved_geometry({box(), circle({1, 2}, 0.5)});
  GeometryBuilder chords;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v)
      chords.add(g.point(v), g.boundary_of(v));
    chords.end_loop();
  }
  EXPECT_NE(std::move(chords).geometry(g.boundaries()).digest(), g.digest());
}

}  // namespace
}  // namespace quadloop
