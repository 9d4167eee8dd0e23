// Where wakes begin, and how a line that cannot begin is refused.
#include "mesher/layers/front/layer_lines.hpp"

#include <gtest/gtest.h>

#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::ten_layers;

/// A box round a body that is blunt at x = -1 and ends at x = 2, in a point or in a base of the given height.
Geometry wedge(double base, const std::optional<LayerSpec>& of_wedge = ten_layers) {
  std::vector<Point> points{{-1, -0.5}, {-1, 0.5}, {0, 0.5}, {2, base / 2}};
  if (base > 0) points.push_back({2, -base / 2});
  points.push_back({0, -0.5});
  return test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}}, {{"wedge", points, of_wedge}}});
}

LayerLine wake_of(const std::string& name) {
  LayerLine wake;
  wake.from = {name};
  wake.length = 3;
  wake.spacing = 0.1;
  return wake;
}

TEST(PlaceLines, AWakeGoesStraightOnFromASharpEdge) {
  const std::vector<PlacedLine> placed = place_lines(wedge(0), {wake_of("wedge")});
  ASSERT_EQ(placed.size(), 1U);
  ASSERT_EQ(placed[0].path.size(), 2U);
  EXPECT_NEAR(placed[0].path[1].x, 5, 1e-12);
  EXPECT_NEAR(placed[0].path[1].y, 0, 1e-12);
  EXPECT_EQ(placed[0].layers, ten_layers);
}

TEST(PlaceLines, AWakeThatFollowsTheFlowHasTheNearestStreamlinesCourse) {
  LayerLine wake = wake_of("wedge");
  wake.follows_flow = true;
  const std::vector<std::vector<Point>> streamlines{{{-2, 0}, {-4, 0}}, {{2, 0.01}, {3, 0.11}, {7, 0.11}}};
  EXPECT_EQ(place_lines(wedge(0), {wake})[0].path.size(), 2U) << "the bisector";
  const PlacedLine placed = place_lines(wedge(0), {wake}, streamlines)[0];
  ASSERT_EQ(placed.path.size(), 3U);
  EXPECT_EQ(placed.path[0], (Point{2, 0})) << "moved to the edge";
  EXPECT_NEAR(placed.path[1].y, 0.1, 1e-12);
  EXPECT_NEAR(length(placed.path[1] - placed.path[0]) + length(placed.path[2] - placed.path[1]), 3, 1e-12);
  EXPECT_EQ(placed.clear_of_all_but.size(), 1U);
  wake.follows_flow = false;
  EXPECT_EQ(place_lines(wedge(0), {wake}, streamlines)[0].path.size(), 2U);
  EXPECT_TRUE(place_lines(wedge(0), {wake}, streamlines)[0].clear_of_all_but.empty());
}

TEST(PlaceLines, AWakeBeginsAtTheEdgeNearestToItsPlace) {
  const Geometry g =
      test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                        {{"dart", {{-2, 0}, {0, 0.5}, {2, 0.05}, {2, -0.05}, {0, -0.5}}, ten_layers}}});
  LayerLine wake = wake_of("dart");
  EXPECT_EQ(test::refusal([&] { place_lines(g, {wake}); }),
            "wake, from = \"dart\": there are 2 trailing edges, at (-2, 0), (2, 0); select the one at which "
            "the wake "
            "begins: at = [x, y]");
  wake.at = Point{2.1, 0.1};
  EXPECT_EQ(place_lines(g, {wake})[0].path[0], (Point{2, 0})) << "the base";
  wake.at = Point{-1.9, 0.1};
  EXPECT_EQ(place_lines(g, {wake})[0].path[0], (Point{-2, 0}));
  wake.at = Point{1.7, 0.1};
  EXPECT_EQ(test::refusal([&] { place_lines(g, {wake}); }),
            "wake, from = \"dart\": at = [1.7, 0.1] is 0.304 from the nearest trailing edge, more than "
            "the 0.2 allowed; there are trailing edges at (-2, 0), (2, 0)");
}

TEST(PlaceLines, ABluntEdgesWakeBeginsInTheMiddleOfItsBase) {
  const Geometry g = wedge(0.1);
  const PlacedLine placed = place_lines(g, {wake_of("wedge")})[0];
  EXPECT_NE(placed.edge, placed.base_end);
  EXPECT_EQ(g.point(placed.edge), (Point{2, 0.05}));
  EXPECT_EQ(g.point(placed.base_end), (Point{2, -0.05}));
  EXPECT_EQ(placed.path[0], (Point{2, 0}));
}

TEST(PlaceLines, APathIsFollowedAsItIsGiven) {
  LayerLine wake = wake_of("wedge");
  wake.path = {{3, 0.1}, {5, 0.5}};
  const std::vector<Point> wanted{{2, 0}, {3, 0.1}, {5, 0.5}};
  EXPECT_EQ(place_lines(wedge(0.1), {wake})[0].path, wanted);
  wake.path.insert(wake.path.begin(), {2, 0});
  EXPECT_EQ(place_lines(wedge(0.1), {wake})[0].path, wanted) << "the edge may be named again";
  LayerLine free;
  free.path = {{-6, -6}, {-5, -6}};
  free.layers = ten_layers;
  const PlacedLine placed = place_lines(wedge(0.1), {free})[0];
  EXPECT_EQ(placed.edge, PlacedLine::nowhere);
  EXPECT_EQ(placed.path, free.path);
}

/// That body as two boundaries, which meet at its edge.
Geometry halves(double base) {
  std::vector<Point> upper{{-1, 0.5}, {0, 0.5}};
  if (base > 0) upper.push_back({2, base / 2});
  const std::vector<Point> lower{{2, -base / 2}, {0, -0.5}, {-1, -0.5}};
  return test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                           {{"upper", upper, ten_layers}, {"lower", lower, ten_layers}}});
}

TEST(PlaceLines, AWakeMayBeginWhereTwoBoundariesMeet) {
  LayerLine wake = wake_of("upper");
  EXPECT_NE(
      test::refusal([&] { place_lines(halves(0), {wake}); }).find("name them all: from = [\"a\", \"b\"]"),
      std::string::npos);
  wake.from = {"upper", "lower"};
  for (const double base : {0.0, 0.1}) {
    const Geometry g = halves(base);
    const PlacedLine placed = place_lines(g, {wake})[0];
    EXPECT_EQ(g.point(placed.edge), (Point{2, base / 2}));
    EXPECT_EQ(g.point(placed.base_end), (Point{2, -base / 2}));
    EXPECT_EQ(placed.path[0], (Point{2, 0}));
  }
}

TEST(PlaceLines, LinesAreNamedByTheirKindAndNumber) {
  LayerLine free;
  free.path = {{-6, -6}, {-5, -6}};
  free.layers = ten_layers;
  free.where = "case.toml:7";
  std::vector<PlacedLine> placed = place_lines(wedge(0), {free, wake_of("wedge"), free});
  EXPECT_EQ(placed[0].name, "layer_line_1");
  EXPECT_EQ(placed[1].name, "wake");
  EXPECT_EQ(placed[2].name, "layer_line_2");
  EXPECT_EQ(placed[0].place, "case.toml:7: ");
  EXPECT_EQ(placed[1].place, "");
}

TEST(PlaceLines, OneEdgeHasOneWake) {
  LayerLine second = wake_of("wedge");
  second.where = "case.toml:9";
  EXPECT_EQ(test::refusal([&] {
              place_lines(wedge(0.1), {wake_of("wedge"), second});
            }).find("case.toml:9: wake_2 begins at the trailing edge at (2, 0), and so does wake_1"),
            0U);
}

TEST(PlaceLines, AWakeNeedsAnEdgeOfABoundaryWithLayers) {
  const auto says = [](const Geometry& g, const std::string& name, const std::string& wanted) {
    const std::string message = test::refusal([&] { place_lines(g, {wake_of(name)}); });
    EXPECT_NE(message.find(wanted), std::string::npos) << message;
  };
  says(wedge(0.1), "wing", "the geometry has no boundary 'wing'; it has: ");
  says(wedge(0.1, std::nullopt), "wedge", "has no layers");
  says(wedge(0.8), "wedge", "no trailing edge found");
}

TEST(PlaceLines, AWakeAtHalfOfATrailingEdgeIsRefusedWithItsPlace) {
  const auto says = [](BoundaryCondition of_axis) {
    const Geometry bare = test::outline_of({{{"axis", {{-8, 0}}},
                                             {"wedge", {{-1, 0}, {-1, 0.5}, {0, 0.5}}, ten_layers},
                                             {"axis", {{2, 0}}},
                                             {"box", {{8, 0}, {8, 8}, {-8, 8}}}}});
    std::vector<Boundary> boundaries(bare.boundaries().begin(), bare.boundaries().end());
    std::vector<BoundaryId> of_segment;
    for (std::int32_t s = 0; s < bare.size(); ++s) of_segment.push_back(bare.boundary_of(s));
    for (Boundary& boundary : boundaries) {
      if (boundary.name == "axis") boundary.condition = of_axis;
    }
    const Geometry g(boundaries, {bare.points().begin(), bare.points().end()}, {0, bare.size()}, of_segment);
    LayerLine wake = wake_of("wedge");
    wake.where = "case.toml:9";
    return test::refusal([&] { place_lines(g, {wake}); });
  };
  EXPECT_EQ(
      says(BoundaryCondition::symmetry),
      "case.toml:9: wake, from = \"wedge\": the wall ends at (-1, 0), (2, 0) on the symmetry boundary "
      "'axis', where a wake would have only one of its two sides, which is not supported; mesh the whole "
      "body (mesh.mirror without mesh.half), or remove the wake");
  EXPECT_NE(says(BoundaryCondition::wall).find("no trailing edge found"), std::string::npos);
}

}  // namespace
}  // namespace quadloop
