// Layers in meshes of several blocks: their columns stand on the nodes of the block on the other side of an
// interface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/generate.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr LayerSpec six_layers{0.01, 1.2, 1.2, 6};  // 0.099 thick together

Chain chain(const std::string& name, bool open, std::vector<Point> points) {
  return {name, open, std::move(points), {}};
}
Chain box(const std::string& name, double x0, double x1, double y0, double y1) {
  return chain(name, false, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
Chain circle(const std::string& name, double radius, int points) {
  Chain made = chain(name, false, {});
  for (int i = 0; i < points; ++i) {
    const double angle = 0.1 + 2 * std::numbers::pi * i / points;
    made.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return made;
}
BlockRule of(const std::string& name, std::vector<std::string> boundaries) {
  return {name, std::move(boundaries), {}, {}, "case"};
}
BlockRule at(const std::string& name, Point p) { return {name, {}, {}, p, "case"}; }
BoundaryRule layers(const std::string& pattern, std::optional<std::string> block = {},
                    const LayerSpec& spec = six_layers) {
  BoundaryRule rule;
  rule.pattern = pattern;
  rule.spacing = 0.06;
  rule.corner_degrees = 15;
  rule.layers = spec;
  rule.layers_in = std::move(block);
  return rule;
}

struct Layout {
  std::vector<Chain> chains;
  std::vector<BlockRule> blocks;
  std::vector<BoundaryRule> rules;

  MeshInput input(MeshType type = MeshType::hybrid) const {
    AssembleOptions options;
    options.blocks = blocks;
    options.rules = rules;
    Warnings warnings;
    MeshInput made{assemble(chains, options, warnings), {}, {}, 0};
    made.mesh.type = type;
    made.mesh.size.min = 0.015;
    made.mesh.size.max = 0.2;
    made.smooth.sweeps = 5;
    return made;
  }
};

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

double area_of_block(const Geometry& g, std::int32_t block) {
  double twice = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.block_of(s) == block) twice += cross(g.point(s), g.point(g.next(s)));
  }
  return twice / 2;
}

bool has_edge(const Mesh& whole, std::int32_t block, const std::array<NodeId, 2>& edge) {
  const auto in = [&](const auto& cells, const std::vector<std::int32_t>& blocks) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t k = 0; blocks[i] == block && k < cells[i].size(); ++k) {
        if (cells[i][k] == edge[0] && cells[i][(k + 1) % cells[i].size()] == edge[1]) return true;
      }
    }
    return false;
  };
  return in(whole.triangles, whole.blocks.of_triangles) || in(whole.quads, whole.blocks.of_quads);
}

/// Quadrilaterals of a block, or pairs of triangles, that are as high as the first layer and stand on the
/// interface, counted by their nodes: those at the height of the first layer above a node of it, in the
/// block.
std::int64_t columns_on(const Mesh& whole, std::size_t boundary, double first) {
  std::vector<Point> feet;
  for (const auto& edge : whole.boundaries[boundary].edges) feet.push_back(whole.point(edge[0]));
  return std::ranges::count_if(feet, [&](Point foot) {
    return std::ranges::any_of(whole.points,
                               [&](Point p) { return std::abs(length(p - foot) - first) < 0.02 * first; });
  });
}

/// Both types of mesh are valid and fill each block; edges between two blocks have the first block to their
/// left, and a share of the nodes on `boundary` has columns.
void expect_layers(const Layout& layout, const std::string& boundary, double share, double tolerance = 1e-9) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const MeshInput input = layout.input(type);
    const Geometry& g = input.geometry;
    const Mesh made = generate_mesh(world(), input).result.mesh, whole = gather_whole(world(), made);
    if (!world().is_root()) continue;
    const auto count = static_cast<std::int32_t>(g.block_names().size());
    for (const MeshFault& fault : validate(whole, {count, whole.blocks.of_triangles, whole.blocks.of_quads}))
      ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what << " at " << fault.place.x << " "
                    << fault.place.y;
    for (std::int32_t b = 0; b < count; ++b)
      EXPECT_NEAR(area_of_block(whole, b), area_of_block(g, b), tolerance * area_of_block(g, b))
          << g.block_names()[b];
    ASSERT_EQ(whole.boundaries.size(), g.boundaries().size());
    for (std::int32_t s = 0; s < g.size(); ++s) {
      if (g.twin(s) < 0 || g.block_of(s) > g.block_of(g.twin(s))) continue;
      const BoundaryEdges& interface = whole.boundaries[g.boundary_of(s).value()];
      EXPECT_TRUE(made.boundaries[g.boundary_of(s).value()].between_blocks);
      ASSERT_FALSE(interface.edges.empty());
      EXPECT_TRUE(has_edge(whole, g.block_of(s), interface.edges.front())) << interface.name;
    }
    const auto found = std::ranges::find(whole.boundaries, boundary, &BoundaryEdges::name);
    ASSERT_NE(found, whole.boundaries.end());
    EXPECT_GE(static_cast<double>(columns_on(whole, found - whole.boundaries.begin(), six_layers.first)),
              share * static_cast<double>(found->edges.size()));
  }
}

const Layout ring{{box("wall", -1.5, 1.5, -1, 1), circle("surface", 0.5, 60), circle("heater", 0.3, 60)},
                  {of("fluid", {"wall", "surface"}), of("solid", {"surface", "heater"})},
                  {}};

TEST(BlockLayers, OutsideASolidRingInAFlow) {
  Layout layout = ring;
  layout.rules = {layers("surface", "fluid")};
  expect_layers(layout, "surface", 0.95, 0.01);
  std::ranges::reverse(layout.blocks);
  expect_layers(layout, "surface", 0.95, 0.01);
}

TEST(BlockLayers, InsideTheRingAndOnBothSidesOfIt) {
  Layout layout = ring;
  layout.rules = {layers("surface", "solid", {0.01, 1, 1, 3})};
  expect_layers(layout, "surface", 0.95, 0.01);
  layout.rules = {layers("surface", {}, {0.01, 1, 1, 3}), layers("heater", {}, {0.01, 1, 1, 3})};
  expect_layers(layout, "surface", 0.95, 0.01);
}

TEST(BlockLayers, RoundAnglesAndSharpEdges) {
  Layout layout{{box("wall", -1, 3, -1, 1), box("square", -0.4, 0.4, -0.4, 0.4),
                 chain("fin", false, {{1, 0}, {1.6, -0.12}, {2.2, 0}, {1.6, 0.12}})},
                {of("fluid", {"wall", "square", "fin"}), of("solid", {"square"}), of("thin", {"fin"})},
                {layers("square", "fluid"), layers("fin", "fluid")}};
  expect_layers(layout, "square", 0.8);
  expect_layers(layout, "fin", 0.8);
}

const Layout plate{{box("duct", 0, 2, 0, 1), box("plate", 0, 2, -0.5, 0)},
                   {at("solid", {1, -0.2}), at("fluid", {1, 0.5})},
                   {}};

TEST(BlockLayers, EndOnTheWallsBesideAnInterface) {
  Layout layout = plate;
  layout.rules = {layers("solid__fluid", "fluid")};
  expect_layers(layout, "solid__fluid", 0.9);
  layout.rules = {layers("solid__fluid", "solid")};
  expect_layers(layout, "solid__fluid", 0.9);
  layout.rules = {layers("solid__fluid")};
  expect_layers(layout, "solid__fluid", 0.9);
}

TEST(BlockLayers, PassFromAnInterfaceToWalls) {
  Layout layout = plate;
  layout.rules = {layers("solid__fluid", "fluid"), layers("duct", "fluid")};
  expect_layers(layout, "solid__fluid", 0.8);
}

TEST(BlockLayers, PassOverTheMeetingOfThreeBlocks) {
  const Layout layout{{box("duct", 0, 2, 0, 1), box("left", 0, 0.7, -0.5, 0), box("right", 0.7, 2, -0.5, 0)},
                      {at("a", {0.2, -0.2}), at("b", {1, -0.2}), at("fluid", {1, 0.5})},
                      {layers("?__fluid", "fluid")}};
  expect_layers(layout, "a__fluid", 0.9);
  expect_layers(layout, "b__fluid", 0.9);
}

TEST(BlockLayers, OnOuterWallsAlone) {
  Layout layout = ring;
  layout.rules = {layers("wall"), layers("heater")};
  expect_layers(layout, "wall", 0.8, 0.01);
}

bool has_text(const std::vector<std::string>& warnings, const std::string& text) {
  return std::ranges::any_of(warnings,
                             [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

TEST(BlockLayers, AreReportedAsOnWalls) {
  Layout layout = plate;
  for (const std::optional<std::string>& block :
       {std::optional<std::string>("fluid"), std::optional<std::string>("solid"),
        std::optional<std::string>()}) {
    layout.rules = {layers("solid__fluid", block)};
    const GeneratedMesh made = generate_mesh(world(), layout.input());
    ASSERT_EQ(made.layers.size(), 1U);
    EXPECT_EQ(made.layers[0].boundary, "solid__fluid");
    EXPECT_EQ(made.layers[0].reached, 6);
    EXPECT_GT(made.layers[0].columns, 20);
    EXPECT_NEAR(made.layers[0].first_least, 0.01, 1e-12);
    EXPECT_EQ(made.layers[0].share_least, 1);
  }
}

TEST(BlockLayers, ThatAreThinOrNextToLargeCellsAreWarnedOf) {
  Layout layout{{box("duct", 0, 2, 0, 0.1), box("plate", 0, 2, -0.5, 0)},
                {at("solid", {1, -0.2}), at("fluid", {1, 0.05})},
                {layers("solid__fluid", "fluid")}};
  EXPECT_TRUE(has_text(generate_mesh(world(), layout.input()).result.report.warnings,
                       "boundary 'solid__fluid': near ("));
  layout = plate;
  layout.rules = {layers("solid__fluid", "fluid")};
  MeshInput coarse = layout.input();
  coarse.mesh.size.min = 0.06;
  EXPECT_TRUE(has_text(generate_mesh(world(), coarse).result.report.warnings,
                       "boundary 'solid__fluid': its last layer is"));
}

TEST(BlockLayers, ThatEndOnAnInterfaceAreRefused) {
  Layout layout = plate;
  layout.rules = {layers("duct", "fluid")};
  try {
    generate_mesh(world(), layout.input());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("layers_in = \"fluid\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quadloop
