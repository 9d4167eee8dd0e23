// What an outline asks for at single places: corners, lengths, turns, and demands in their place.
#include "mesher/geometry/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/base/error.hpp"

namespace quadloop {
namespace {

/// A square of edge 2, its right side bent outwards a little in the middle.
Geometry house(std::optional<LayerSpec> layers = {}) {
  Boundary wall{"wall", 0.5, 30, "wall"};
  wall.layers = layers;
  return {
      {wall}, {{0, 0}, {2, 0}, {2.1, 1}, {2, 2}, {0, 2}}, {0, 5}, std::vector<BoundaryId>(5, BoundaryId{0})};
}

TEST(Geometry, BendsWhereItIsNoCorner) {
  const Geometry g = house();
  EXPECT_EQ(g.bend_degrees(0), 0) << "a kept corner";
  EXPECT_EQ(g.bend_degrees(2), g.turn_degrees(2));
  EXPECT_NEAR(g.bend_degrees(2), 11.42, 0.01);
}

/// Most turns are told without an arc tangent; that may change nothing, wherever the limit lies.
TEST(Geometry, KeepsWhatTurnsByMoreThanItsBoundarysCorner) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<Point> points{{0, 0}};
  double heading = 0;
  for (int i = 0; i < 4000; ++i) {
    const double turn = i % 4 == 0   ? 180 * share(random)
                        : i % 4 == 1 ? 30
                        : i % 4 == 2 ? 2e-6 * share(random)
                                     : 0;
    heading += turn * std::numbers::pi / 180;
    const double step = std::exp(10 * share(random));
    points.push_back(points.back() + Point{step * std::cos(heading), step * std::sin(heading)});
  }
  for (const double corner : {0.0, 1e-6, 30.0, 88.0, 89.0, 90.0, 120.0, 180.0}) {
    const Geometry g({Boundary{"wall", 0, corner}}, points, {0, size32(points)},
                     std::vector<BoundaryId>(points.size(), BoundaryId{0}));
    for (std::int32_t v = 0; v < g.size(); ++v) {
      EXPECT_EQ(g.kept(v), g.turn_degrees(v) > corner) << v;
      EXPECT_EQ(g.straight(v), g.turn_degrees(v) < Geometry::straight_degrees) << v;
    }
  }
}

TEST(Geometry, LoopsCloseOnThemselves) {
  const Geometry g({Boundary{"wall"}}, {{0, 0}, {9, 0}, {0, 9}, {1, 1}, {1, 2}, {2, 1}, {3, 1}}, {0, 3, 7},
                   std::vector<BoundaryId>(7, BoundaryId{0}));
  const std::vector<std::int32_t> next{1, 2, 0, 4, 5, 6, 3}, previous{2, 0, 1, 6, 3, 4, 5};
  for (std::int32_t v = 0; v < g.size(); ++v) {
    EXPECT_EQ(g.next(v), next[v]);
    EXPECT_EQ(g.previous(v), previous[v]);
    EXPECT_EQ(g.loop_of(v), v < 3 ? 0 : 1);
  }
}

TEST(Geometry, DemandsOfSinglePlacesReplaceTheBoundarys) {
  const Geometry plain = house();
  const Geometry g = plain.with({{0.1, 0.2, 0.3, 0.4, 0.6}, {1, 0, 1, 0, 0}, {0, 5, 0, 0, 7}});
  EXPECT_EQ(plain.spacing_of(1), 0.5);
  EXPECT_EQ(g.spacing_of(1), 0.2);
  EXPECT_EQ(g.spacing_of(4), 0.6);
  EXPECT_TRUE(plain.kept(1));
  EXPECT_FALSE(g.kept(1));
  EXPECT_TRUE(g.kept(2));
  EXPECT_EQ(g.bend_degrees(1), 5);
  EXPECT_EQ(g.bend_degrees(2), 0);
  EXPECT_EQ(g.turn_degrees(2), plain.turn_degrees(2)) << "the outline is the same";
  EXPECT_EQ(g.size(), plain.size());
}

/// Else one triangle spans both corners of a blunt trailing edge.
TEST(Geometry, AnEdgeBetweenKeptCornersAsksForItsOwnLength) {
  const std::vector<Point> points{{0, 0}, {1, -0.25}, {2, 0}, {2, 0.125}, {1, 0.25}};
  const auto blunt = [&](double spacing, double corner) {
    return Geometry({Boundary{"wall", spacing, corner}}, points, {0, 5},
                    std::vector<BoundaryId>(5, BoundaryId{0}));
  };
  EXPECT_EQ(blunt(0.5, 45).spacing_of(2), 0.125);
  EXPECT_EQ(blunt(0.5, 45).spacing_of(1), 0.5) << "it ends at one kept corner alone";
  EXPECT_EQ(blunt(0.0625, 45).spacing_of(2), 0.0625) << "a finer boundary stays as fine";
  EXPECT_EQ(blunt(0.5, 180).spacing_of(2), 0.5) << "no corner is kept";
}

TEST(Geometry, SeveralSegmentsBetweenKeptCornersAskForTheirLengthTogether) {
  const std::vector<Point> points{{0, 0}, {1, -0.25}, {2, 0}, {2, 0.0625}, {2, 0.125}, {1, 0.25}};
  const auto blunt = [&](double spacing) {
    return Geometry({Boundary{"wall", spacing, 45}}, points, {0, 6},
                    std::vector<BoundaryId>(6, BoundaryId{0}));
  };
  EXPECT_EQ(blunt(0.5).spacing_of(2), 0.125);
  EXPECT_EQ(blunt(0.5).spacing_of(3), 0.125);
  EXPECT_EQ(blunt(0.5).spacing_of(4), 0.5);
  EXPECT_EQ(blunt(0).spacing_of(2), 0.0625) << "without a spacing each segment asks for its own length";
}

TEST(Geometry, ThereIsOneDemandForEachPlace) {
  EXPECT_THROW(house().with({{0.1}, {1, 0, 1, 0, 0}, {0, 5, 0, 0, 7}}), Fault);
  EXPECT_THROW(house().with({{0.1, 0.2, 0.3, 0.4, 0.6}, {1}, {0, 5, 0, 0, 7}}), Fault);
  EXPECT_THROW(house().with({{0.1, 0.2, 0.3, 0.4, 0.6}, {1, 0, 1, 0, 0}, {}}), Fault);
}

TEST(Geometry, ItsDigestTellsEveryNumberOfTheLayers) {
  const LayerSpec layers{1e-3, 1.2, 1.3, 10, 2};
  std::vector<std::uint64_t> digests{house().digest(), house(layers).digest()};
  const auto changed = [&](auto member, auto value) {
    LayerSpec other = layers;
    other.*member = value;
    digests.push_back(house(other).digest());
  };
  changed(&LayerSpec::first, 2e-3);
  changed(&LayerSpec::growth, 1.1);
  changed(&LayerSpec::growth_to, 1.4);
  changed(&LayerSpec::count, 11);
  changed(&LayerSpec::equal, 1);
  std::ranges::sort(digests);
  EXPECT_EQ(std::ranges::adjacent_find(digests), digests.end());
}

}  // namespace
}  // namespace quadloop
