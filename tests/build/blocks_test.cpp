// Meshes of several blocks: valid, conforming across interfaces, the same on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/build/sound_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

struct Blocks {
  std::vector<Chain> chains;
  std::vector<BlockRule> rules;

  Geometry geometry() const {
    AssembleOptions options;
    options.blocks = rules;
    Warnings warnings;
    return assemble(chains, options, warnings);
  }
};

Chain loop(const std::string& name, std::vector<Point> points) {
  return {name, false, std::move(points), {}};
}
Chain line(const std::string& name, std::vector<Point> points) { return {name, true, std::move(points), {}}; }
std::vector<Point> box_points(double x0, double x1, double y0, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
std::vector<Point> circle(Point centre, double radius, int points, double start = 0.1) {
  std::vector<Point> result;
  for (int i = 0; i < points; ++i) {
    const double angle = start + 2 * std::numbers::pi * i / points;
    result.push_back(centre + radius * Point{std::cos(angle), std::sin(angle)});
  }
  return result;
}
BlockRule of_loop(const std::string& name, const std::string& loop) { return {name, {}, loop, {}, "case"}; }
BlockRule at(const std::string& name, Point p) { return {name, {}, {}, p, "case"}; }

MeshOptions between(double min, double max) {
  MeshOptions options;
  options.size.min = min;
  options.size.max = max;
  return options;
}

double area_of_block(const Mesh& whole, std::int32_t block) {
  double area = 0;
  const auto add = [&](const auto& cells, const std::vector<std::int32_t>& blocks) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (blocks[i] != block) continue;
      const auto p = corners_of(whole, cells[i]);
      for (std::size_t k = 1; k + 1 < p.size(); ++k) area += 0.5 * cross(p[k] - p[0], p[k + 1] - p[0]);
    }
  };
  add(whole.triangles, whole.blocks.of_triangles);
  add(whole.quads, whole.blocks.of_quads);
  return area;
}

double wanted_area(const Geometry& g, std::int32_t block) {
  double twice = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.block_of(s) == block) twice += cross(g.point(s), g.point(g.next(s)));
  }
  return twice / 2;
}

/// Each type of mesh is valid, fills each block, and is the same on one rank.
void expect_meshes(const Blocks& blocks, const MeshOptions& given, double tolerance = 0.01) {
  const Geometry geometry = blocks.geometry();
  test::expect_sound_meshes(geometry, given, [&](const Mesh& whole, const MeshResult&) {
    for (std::int32_t b = 0; b < size32(geometry.block_names()); ++b) {
      const double wanted = wanted_area(geometry, b);
      EXPECT_NEAR(area_of_block(whole, b), wanted, tolerance * wanted) << geometry.block_names()[b];
    }
  });
}

TEST(Blocks, ASquareInASquareOnGridLines) {
  expect_meshes({{loop("wall", box_points(0, 1, 0, 1)), loop("ring", box_points(0.25, 0.75, 0.25, 0.75))},
                 {of_loop("fluid", "wall"), of_loop("solid", "ring")}},
                between(0.05, 0.1), 1e-12);
}

TEST(Blocks, ADiscInASquareAndAHollowOne) {
  expect_meshes({{loop("wall", box_points(0, 1, 0, 1)), loop("ring", circle({0.48, 0.53}, 0.31, 50))},
                 {of_loop("fluid", "wall"), of_loop("solid", "ring")}},
                between(0.02, 0.1));
  const Blocks hollow{{loop("wall", box_points(0, 1, 0, 1)), loop("ring", circle({0.48, 0.53}, 0.31, 50)),
                       loop("hole", circle({0.5, 0.5}, 0.13, 30))},
                      {at("fluid", {0.01, 0.01}), at("solid", {0.3, 0.5})}};
  expect_meshes(hollow, between(0.02, 0.1));
  const Geometry g = hollow.geometry();
  ASSERT_EQ(g.boundaries().size(), 3U);
  EXPECT_EQ(g.boundaries()[1].name, "ring");
}

TEST(Blocks, AnInterfaceThatTouchesGridLinesUpToRoundingHasOneNodeThere) {
  const Blocks disc{{loop("wall", box_points(0, 1, 0, 1)), loop("ring", circle({0.5, 0.5}, 0.25, 64, 0))},
                    {of_loop("fluid", "wall"), of_loop("solid", "ring")}};
  expect_meshes(disc, between(0.02, 0.04));
  const Mesh mesh = build_mesh(world(), disc.geometry(), between(0.02, 0.04)).mesh;
  EXPECT_GT(summarise_quality(world(), mesh).smallest_degrees, 5);
}

/// An interface asks for little more leaves than the boundary of a hole, and is no gap.
void expect_plain_interface(const std::vector<Point>& ring) {
  const Blocks two{{loop("wall", box_points(0, 1, 0, 1)), loop("ring", ring)},
                   {of_loop("fluid", "wall"), of_loop("solid", "ring")}},
      hole{two.chains, {at("fluid", {0.01, 0.01})}};
  const auto leaves = [](const Blocks& blocks, std::optional<double> gap) {
    MeshOptions options = between(0.004, 0.1);
    options.size.curvature = 20;
    options.size.gap = gap;
    return build_mesh(world(), blocks.geometry(), options).report.leaves;
  };
  EXPECT_LT(leaves(two, {}), 1.3 * static_cast<double>(leaves(hole, {})));
  EXPECT_EQ(leaves(two, 2), leaves(two, {}));
}

TEST(Blocks, AnInterfaceTurnsOnceAndIsNoGap) {
  for (int trial = 0; trial < 8; ++trial)
    expect_plain_interface(circle({0.48 + 0.003 * trial, 0.53}, 0.31, 60, 0.1 * trial));
}

TEST(Blocks, OfTwoEquallyFarPointsBothSidesKeepTheSame) {
  const Blocks blocks{
      {loop("wall", box_points(0, 1, 0, 1)),
       line("line", {{0, 0.6}, {0.535, 0.6}, {0.615, 0.64}, {0.635, 0.64}, {0.715, 0.6}, {1, 0.6}})},
      {at("low", {0.1, 0.1}), at("high", {0.1, 0.9})}};
  const MeshResult made = build_mesh(world(), blocks.geometry(), between(0.2, 0.25));
  std::int64_t edges = 0;
  for (const BoundaryEdges& boundary : made.mesh.boundaries) {
    if (boundary.name == "line") edges = std::ssize(boundary.edges);
  }
  EXPECT_EQ(world().sum(edges), 5) << "four leaves, in one of them one of two points";
}

TEST(Blocks, ThreeMeetAtAPoint) {
  for (const Point centre : {Point{0.5, 0.5}, Point{0.47, 0.55}, Point{0.5, 0.43}}) {
    const Blocks blocks{{loop("wall", box_points(0, 1, 0, 1)), line("cut", {{0, 0.1}, centre, {1, 0.2}}),
                         line("up", {centre, {0.4, 1}})},
                        {at("low", {0.5, 0.01}), at("left", {0.1, 0.9}), at("right", {0.9, 0.9})}};
    const Geometry g = blocks.geometry();
    std::vector<std::string> names;
    for (const Boundary& b : g.boundaries()) names.push_back(b.name);
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"low__left", "low__right", "up", "wall"}));
    expect_meshes(blocks, between(0.02, 0.1));
  }
}

/// Blocks of closed lines, of which the later ones take precedence.
Blocks of_loops(const std::vector<std::vector<Point>>& loops) {
  Blocks blocks;
  for (const std::vector<Point>& points : loops) {
    const std::string name = "loop" + std::to_string(blocks.rules.size());
    blocks.chains.push_back(loop(name, points));
    blocks.rules.push_back(of_loop("block_of_" + name, name));
  }
  return blocks;
}

void expect_wide_angles(const Blocks& blocks, const MeshOptions& options) {
  expect_meshes(blocks, options, 1e-9);
  const Mesh mesh = build_mesh(world(), blocks.geometry(), options).mesh;
  EXPECT_GT(summarise_quality(world(), mesh).smallest_degrees, 15);
}

/// Four blocks around a point, three at the edge of the domain, on grid lines in no direction, one or both.
TEST(Blocks, MeetAtPointsOnGridLines) {
  const Blocks four = of_loops({box_points(0, 10, 0, 10), box_points(0, 10, 10, 20),
                                box_points(10, 20, 0, 10), box_points(10, 20, 10, 20)});
  MeshOptions options = between(1, 2);
  for (const double x : {-6.0, -6.2, -6.5, -7.0}) {
    for (const double y : {-6.0, -6.2, -6.5, -7.0}) {
      SCOPED_TRACE("root at " + std::to_string(x) + ", " + std::to_string(y));
      options.size.root = RootOptions{{x, y}, 32, 1, 1};
      expect_wide_angles(four, options);
    }
  }
}

/// 259.8 and 359.8 differ from grid lines by rounding.
TEST(Blocks, MeetAtPointsOnGridLinesUpToRounding) {
  MeshOptions options = between(10, 10);
  options.size.root = RootOptions{{-160, -1370.2}, 1280, 2, 2};
  expect_wide_angles(of_loops({box_points(400, 700, 115, 504.6), box_points(620, 760, 259.8, 359.8)}),
                     options);
  expect_wide_angles(of_loops({box_points(620, 760, 259.8, 359.8), box_points(400, 700, 359.8, 504.6)}),
                     options);
}

TEST(Blocks, AStackOfLayersOnAndBesideGridLines) {
  for (const double shift : {0.0, 0.013}) {
    Blocks stack{{loop("wall", box_points(0, 1, 0, 1))}, {}};
    for (int i = 1; i < 4; ++i) {
      const double y = 0.25 * i + shift;
      stack.chains.push_back(line("line", {{0, y}, {0.3, y}, {1, y}}));
    }
    for (int i = 0; i < 4; ++i) stack.rules.push_back(at("b" + std::to_string(i), {0.5, 0.25 * i + 0.1}));
    expect_meshes(stack, between(0.03, 0.125), 1e-9);
  }
}

TEST(Blocks, FinelySampledInterfacesOnGridLines) {
  std::vector<Point> ring;
  const auto side = [&](Point from, Point to) {
    for (int i = 0; i < 13; ++i) ring.push_back(from + (i / 13.0) * (to - from));
  };
  side({0.25, 0.25}, {0.75, 0.25});
  side({0.75, 0.25}, {0.75, 0.75});
  side({0.75, 0.75}, {0.25, 0.75});
  side({0.25, 0.75}, {0.25, 0.25});
  const Blocks blocks{{loop("wall", box_points(0, 1, 0, 1)), loop("ring", ring)},
                      {of_loop("solid", "wall"), of_loop("gas", "ring")}};
  expect_meshes(blocks, between(0.01, 0.2), 1e-9);
  MeshOptions fine_below = between(0.01, 0.2);
  fine_below.size.sources = {{Box{{0.3, 0.6}, {0.1, 0.2}}, 0.01, "source"}};
  expect_meshes(blocks, fine_below, 1e-9);
}

/// Loops over and across each other, later ones on top.
Blocks random_blocks(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  Blocks blocks{{loop("wall", box_points(0, 1, 0, 1))}, {of_loop("outer", "wall")}};
  const int count = 1 + static_cast<int>(random() % 4);
  for (int i = 0; i < count; ++i) {
    const std::string name = "shape" + std::to_string(i);
    const Point centre{number(0.25, 0.75), number(0.25, 0.75)};
    const double size = number(0.05, 0.22);
    const int kind = static_cast<int>(random() % 3);
    const auto eighth = [](double x) { return std::round(8 * x) / 8; };
    std::vector<Point> points =
        kind == 0   ? circle(centre, size, 9 + static_cast<int>(random() % 30), number(0, 1))
        : kind == 1 ? box_points(centre.x - size, centre.x + size, centre.y - size, centre.y + size)
                    : box_points(eighth(centre.x) - 0.125, eighth(centre.x) + 0.125, eighth(centre.y) - 0.125,
                                 eighth(centre.y) + 0.125);
    blocks.chains.push_back(loop(name, std::move(points)));
    blocks.rules.push_back(of_loop("b" + std::to_string(i), name));
  }
  if (random() % 2 == 0) {  // a line across all of them
    const double y = random() % 2 == 0 ? 0.5 : number(0.2, 0.8);
    blocks.chains.push_back(line("across", {{0, y}, {1, random() % 2 == 0 ? y : number(0.2, 0.8)}}));
    blocks.rules.insert(blocks.rules.begin() + 1, at("half", {0.01, 0.99}));
  }
  return blocks;
}

TEST(Blocks, RandomArrangementsAreValidOrRefusedWithAPlace) {
  std::mt19937 random(43);
  int made = 0, refused = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const Blocks blocks = random_blocks(random);
    try {
      expect_meshes(blocks, between(0.01, 0.12), 0.07);
      ++made;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("block"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(made, 75) << refused;
}

/// The longest edge of the quadrilaterals of a block.
double longest_of_quads(const Mesh& whole, std::int32_t block) {
  double longest = 0;
  for (std::size_t i = 0; i < whole.quads.size(); ++i) {
    if (whole.blocks.of_quads[i] != block) continue;
    const auto p = corners_of(whole, whole.quads[i]);
    for (std::size_t k = 0; k < 4; ++k) longest = std::max(longest, length(p[(k + 1) % 4] - p[k]));
  }
  return longest;
}

TEST(Blocks, HaveSizesOfTheirOwn) {
  const Blocks blocks{{loop("wall", box_points(0, 2, 0, 1)), line("cut", {{0.9, -0.1}, {1.1, 1.1}})},
                      {at("coarse", {0.2, 0.5}), at("fine", {1.8, 0.5})}};
  const Geometry geometry = blocks.geometry();
  MeshOptions options = between(0.01, 0.13);
  options.size.sources.push_back(
      {SizeSource::Block{"fine", std::make_shared<OutlineRegion>(geometry, 1)}, 0.032});
  expect_meshes(blocks, options, 1e-9);
  const Mesh whole = gather_whole(world(), build_mesh(world(), geometry, options).mesh);
  if (!world().is_root()) return;
  EXPECT_LT(longest_of_quads(whole, 1), 0.05);
  EXPECT_GT(longest_of_quads(whole, 0), 0.1);
}

TEST(Blocks, AMeetingOfThreeMovesAGridVertexWithAllItsLines) {
  const Point meeting{1.4996, 0.8692}, foot{1.867, 0}, left{0, 0.4584}, right{3, 0.6416};
  const Blocks blocks{{loop("l", {{0, 0}, foot, meeting, left}), loop("r", {foot, {3, 0}, right, meeting}),
                       loop("t", {left, meeting, right, {3, 2}, {0, 2}})},
                      {of_loop("a", "l"), of_loop("b", "r"), of_loop("c", "t")}};
  const Geometry geometry = blocks.geometry();
  const Mesh whole = gather_whole(world(), build_mesh(world(), geometry, between(0.03, 0.1)).mesh);
  if (!world().is_root()) return;
  double nearest = 1;
  for (const Point p : whole.points) {
    if (p != meeting) nearest = std::min(nearest, length(p - meeting));
  }
  EXPECT_GT(nearest, 0.03);
  EXPECT_EQ(std::ranges::count(whole.points, meeting), 1);
}

}  // namespace
}  // namespace quadloop
