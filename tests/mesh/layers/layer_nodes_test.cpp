// The nodes and cells of layers, found by edges alone, in parts of a mesh that are neighbours nowhere.
#include "mesher/mesh/layers/layer_nodes.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/layers/layered_edges.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::LayeredStrip;
using test::world;

Mesh spread(const Mesh& whole) {
  return scatter_mesh(world(), world().is_root() ? whole : Mesh{},
                      world().is_root() ? test::shuffled_order(whole, 7) : MeshOrder{});
}

/// The row of the strip in which the node lies.
std::int32_t row_of(const LayeredStrip& strip, Point p) {
  std::int32_t row = 0;
  while (strip.height(row) < p.y - 1e-9) ++row;
  return row;
}

/// With one boundary of layers, or none, and symmetry before it, or under its name.
std::vector<LayeredStrip> strips() {
  return {{6, 3, 2, false}, {6, 3, 2, true}, {6, 3, 0, false}, {9, 1, 8, true}};
}

TEST(LayerNodes, AreAsManyEdgesFromTheFrontAsThereAreLayersLeft) {
  for (const LayeredStrip& strip : strips()) {
    const Mesh mesh = spread(strip.mesh());
    const LayerPlaces places = layer_places(world(), mesh);
    ASSERT_EQ(places.size(), mesh.points.size());
    for (const NodeId node : places.ids()) {
      const std::int32_t row = row_of(strip, mesh.point(node));
      EXPECT_EQ(places[node].valid(), row <= strip.layers);
      if (!places[node].valid()) continue;
      EXPECT_EQ(places[node].left, strip.layers - row) << mesh.point(node).x;
      EXPECT_EQ(mesh.boundaries[places[node].boundary].name, "wall");
      EXPECT_EQ(on_layered_wall(mesh, places[node]), row == 0);
    }
  }
}

/// The grid above the wall's layers with a strip of two rows in it, along x = 1 to 4, of columns upwards.
Mesh with_strip(const LayeredStrip& grid) {
  Mesh mesh = grid.mesh();
  StripLayers strip{"wake", {1, 0.5}, false, 3, {}};
  for (std::int32_t i = 1; i <= 4; ++i) {
    for (std::int32_t j = 0; j < 3; ++j)
      strip.nodes.push_back(mesh.global(grid.node(i, grid.layers + 1 + j)));
  }
  mesh.strips = {strip};
  return mesh;
}

TEST(LayerNodes, OfAStripAreThoseThatItLists) {
  for (const bool triangles : {false, true}) {
    const LayeredStrip grid{6, 3, 2, triangles};
    const Mesh mesh = spread(with_strip(grid));
    ASSERT_EQ(mesh.strips.size(), 1U);
    const LayerPlaces places = layer_places(world(), mesh);
    for (const NodeId node : places.ids()) {
      const auto row = row_of(grid, mesh.point(node)) - grid.layers - 1;
      const double x = mesh.point(node).x;
      const bool listed = row >= 0 && row < 3 && x >= 1 && x <= 4;
      EXPECT_EQ(places[node].strip, listed ? 0 : -1) << x << " in row " << row;
      if (listed) {
        EXPECT_EQ(places[node].left, row == 1 ? 1 : 0);
        EXPECT_EQ(on_layered_wall(mesh, places[node]), row == 1);
        EXPECT_EQ(layers_at(mesh, places[node]).thickness, 0.5);
      }
    }
    const auto in_layers = [&](const auto& nodes) { return is_layer_cell(places, nodes); };
    const std::int64_t cells =
        std::ranges::count_if(mesh.triangles, in_layers) + std::ranges::count_if(mesh.quads, in_layers);
    EXPECT_EQ(world().sum(cells), (std::int64_t{grid.columns} * grid.layers + 6) * (triangles ? 2 : 1));
    const IdVector<NodeId, double> heights = heights_to_front(world(), mesh, places);
    for (const NodeId node : heights.ids()) {
      if (places[node].strip >= 0) {
        EXPECT_EQ(heights[node], places[node].left) << "rows are of height 1";
      }
    }
  }
}

TEST(LayerNodes, OfAWallStayWhereAStripBeginsAtIt) {
  const LayeredStrip grid{6, 3, 0, false};
  Mesh whole = grid.mesh();
  StripLayers strip{"wake", {3, 0.7}, true, 7, {}};
  for (std::int32_t i = 2; i <= 4; ++i) {
    for (std::int32_t j = 0; j < 7; ++j) strip.nodes.push_back(whole.global(grid.node(i, j)));
  }
  whole.strips = {strip};
  const Mesh mesh = spread(whole);
  const LayerPlaces places = layer_places(world(), mesh);
  for (const NodeId node : places.ids()) {
    const double x = mesh.point(node).x;
    EXPECT_EQ(places[node].strip, x == 3 || x == 4 ? 0 : -1) << "its first column, at 2, is the wall's";
  }
}

TEST(LayerNodes, OfStripsGoWithThemToOneRankAndBack) {
  const LayeredStrip grid{6, 3, 2, false};
  const Mesh whole = with_strip(grid), part = spread(whole), back = gather_whole(world(), part);
  ASSERT_EQ(back.strips.size(), 1U);
  EXPECT_EQ(back.strips, part.strips) << "the same on every rank";
  if (!world().is_root()) return;
  EXPECT_EQ(back.strips[0].layers, whole.strips[0].layers);
  for (std::int32_t column = 0; column < 4; ++column) {
    for (std::int32_t row = 0; row < 3; ++row) {
      const auto at = [&](const Mesh& mesh) { return mesh.points[mesh.strips[0].node(column, row).value()]; };
      EXPECT_EQ(at(back), at(whole));
    }
  }
}

TEST(LayerNodes, AreNoneWhereNoBoundarySaysSo) {
  Mesh whole = LayeredStrip{}.mesh();
  for (BoundaryEdges& boundary : whole.boundaries) boundary.layers = {};
  const Mesh mesh = spread(whole);
  EXPECT_FALSE(has_layers(mesh));
  for (const LayerPlace& place : layer_places(world(), mesh)) EXPECT_FALSE(place.valid());
  for (const double height : heights_to_front(world(), mesh, LayerPlaces(mesh.points.size())))
    EXPECT_EQ(height, 0);
}

TEST(LayerNodes, CellsAreOfLayersUnlessAllTheirNodesAreOnTheFront) {
  for (const LayeredStrip& strip : strips()) {
    const Mesh mesh = spread(strip.mesh());
    const LayerPlaces places = layer_places(world(), mesh);
    const auto in_layers = [&](const auto& nodes) { return is_layer_cell(places, nodes); };
    const std::int64_t cells =
        std::ranges::count_if(mesh.triangles, in_layers) + std::ranges::count_if(mesh.quads, in_layers);
    EXPECT_EQ(world().sum(cells), std::int64_t{strip.columns} * strip.layers * (strip.triangles ? 2 : 1));
  }
  const LayerPlaces front(3, LayerPlace{0, 0});
  EXPECT_FALSE(is_layer_cell(front, std::array{NodeId{0}, NodeId{1}, NodeId{2}}));
}

TEST(LayerNodes, KnowHowHighTheLayersReachAboveThem) {
  for (const LayeredStrip& strip : strips()) {
    const Mesh mesh = spread(strip.mesh());
    const IdVector<NodeId, double> heights = heights_to_front(world(), mesh, layer_places(world(), mesh));
    for (const NodeId node : heights.ids()) {
      const double y = mesh.point(node).y, front = strip.height(strip.layers);
      EXPECT_NEAR(heights[node], y < front ? front - y : 0, 1e-15);
    }
  }
}

/// The outline of a wall from (0, 0) to (4, 0) in unit edges, whose next boundary goes on from there, and
/// the number of that boundary's edges that carry layers.
std::int64_t edges_carried(std::vector<Point> beyond, bool backwards) {
  std::vector<Point> points{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}};
  points.insert(points.end(), beyond.begin(), beyond.end());
  Mesh mesh;
  mesh.owned_nodes = size32(points);
  BoundaryEdges wall{"wall", "none", {}, {2, 1}}, next{"next", "none", {}};
  for (std::int32_t i = 0; i + 1 < size32(points); ++i) {
    std::array edge{NodeId{i}, NodeId{i + 1}};
    if (backwards) std::swap(edge[0], edge[1]);
    (i < 4 ? wall : next).edges.push_back(edge);
  }
  for (Point& p : points) p = backwards ? Point{-p.x, p.y} : p;
  mesh.points = points;
  mesh.boundaries = {wall, next};
  const std::vector<LayeredEdge> edges = layered_edges(world(), spread(mesh));
  return world().sum(std::ssize(edges)) - 4;
}

TEST(LayeredEdges, GoOnAlongTheNextBoundaryToItsFirstCornerThatHoldsAColumn) {
  for (const bool backwards : {false, true}) {
    EXPECT_EQ(edges_carried({{4, 1}, {4, 2}}, backwards), 0) << "90 degrees";
    EXPECT_EQ(edges_carried({{4.6, 1}, {5.2, 2}}, backwards), 0) << "120 degrees";
    EXPECT_EQ(edges_carried({{5, 0}, {6, 0}, {6, 1}}, backwards), 2) << "straight on";
    EXPECT_EQ(edges_carried({{5, 0.2}, {6, 0.4}}, backwards), 2) << "160 degrees";
    EXPECT_EQ(edges_carried({{4, -1}, {4, -2}}, backwards), 2) << "away from the domain";
    EXPECT_EQ(edges_carried({{3, 0.3}, {2, 0.6}}, backwards), 2) << "a sharp corner into the domain";
    EXPECT_EQ(edges_carried({{5, 1}, {6, 2}}, backwards), 2) << "45 degrees, edges as wide as the wall's";
    EXPECT_EQ(edges_carried({{4.1, 0.1}, {4.3, 0.3}}, backwards), 0) << "45 degrees, edges of a column";
  }
}

}  // namespace
}  // namespace quadloop
