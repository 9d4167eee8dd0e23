// Layers are left as they are, whatever they cost, and the mesh beside them is bettered.
#include "smoother/keep_layers.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesher/mesh/check/delaunay_check.hpp"
#include "smoother/smooth_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::LayeredStrip;
using test::world;

constexpr LayeredStrip strip_of_quads{12, 3, 2, false}, strip_of_triangles{12, 3, 2, true};

/// With the nodes inside the rows above the layers moved about.
Mesh shaken(const LayeredStrip& strip) {
  Mesh mesh = strip.mesh();
  for (std::int32_t j = strip.layers + 1; j < strip.rows(); ++j) {
    for (std::int32_t i = 1; i < strip.columns; ++i) {
      const NodeId node = strip.node(i, j);
      mesh.points[node.value()].x += 0.3 * test::scattered(5, node.value(), 0);
      mesh.points[node.value()].y += 0.3 * test::scattered(5, node.value(), 1);
    }
  }
  return mesh;
}

Mesh spread(const Mesh& whole) {
  return scatter_mesh(world(), world().is_root() ? whole : Mesh{},
                      world().is_root() ? own_order(whole) : MeshOrder{});
}

void expect_layers_kept(const LayeredStrip& strip, const Mesh& after, const Mesh& before) {
  bool moved = false;
  for (std::int32_t i = 0; i < after.owned_nodes; ++i) {
    const bool in_layers = before.points[i].y <= strip.height(strip.layers);
    if (in_layers) {
      EXPECT_EQ(after.points[i], before.points[i]);
    }
    moved = moved || after.points[i] != before.points[i];
  }
  EXPECT_TRUE(world().any(moved));
}

TEST(KeepLayers, TheirNodesStayToTheBit) {
  const Mesh before = spread(shaken(strip_of_quads));
  Mesh mesh = before;
  SmoothOptions options;
  options.pinned = NodeFlags(mesh.owned_nodes, 0);
  keep_layers(world(), mesh, options);
  smooth_mesh(world(), mesh, options);
  expect_layers_kept(strip_of_quads, mesh, before);
}

TEST(KeepLayers, StripsStayAndWhatIsStretchedBesideThemMoves) {
  Mesh whole = strip_of_quads.mesh();
  StripLayers strip{"wake", {1, 2}, false, 3, {}};
  for (std::int32_t i = 2; i <= 6; ++i) {
    for (std::int32_t j = 4; j <= 6; ++j) strip.nodes.push_back(whole.global(strip_of_quads.node(i, j)));
  }
  const NodeId beside = strip_of_quads.node(9, 5);
  whole.points[beside.value()].x += 0.95;  // a sliver to its right
  const auto pinned = [&](const Mesh& of) {
    const Mesh mesh = spread(of);
    SmoothOptions options;
    keep_layers(world(), mesh, options);
    std::vector<GlobalNodeId> own;
    for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
      if (options.pinned[node] != 0) own.push_back(mesh.global(node));
    }
    return world().all_gather_values(std::span<const GlobalNodeId>(own));
  };
  const auto has = [](const std::vector<GlobalNodeId>& nodes, NodeId node) {
    return std::ranges::find(nodes, GlobalNodeId{node.value()}) != nodes.end();
  };
  const std::vector<GlobalNodeId> unnamed = pinned(whole);
  EXPECT_TRUE(has(unnamed, beside)) << "a file that names no strips: shapes alone tell";
  EXPECT_FALSE(has(unnamed, strip_of_quads.node(4, 5)));
  whole.strips = {strip};
  const std::vector<GlobalNodeId> named = pinned(whole);
  EXPECT_FALSE(has(named, beside));
  for (std::int32_t i = 2; i <= 6; ++i) EXPECT_TRUE(has(named, strip_of_quads.node(i, 5))) << i;
}

TEST(KeepLayers, WhatIsPinnedStaysSoAndNothingIsAskedWithoutLayers) {
  Mesh mesh = spread(strip_of_quads.mesh());
  SmoothOptions options;
  options.pinned = NodeFlags(mesh.owned_nodes, 1);
  keep_layers(world(), mesh, options);
  EXPECT_EQ(options.pinned, NodeFlags(mesh.owned_nodes, 1));
  for (BoundaryEdges& boundary : mesh.boundaries) boundary.layers = {};
  SmoothOptions none;
  keep_layers(world(), mesh, none);
  EXPECT_TRUE(none.pinned.empty());
}

TEST(KeepLayers, FlipsSpareTheirCells) {
  const Mesh before = spread(shaken(strip_of_triangles));
  Mesh mesh = before;
  SmoothOptions options;
  options.delaunay = [](Point p) { return tie_rank({0, 0}, p); };
  keep_layers(world(), mesh, options);
  smooth_mesh(world(), mesh, options);
  expect_layers_kept(strip_of_triangles, mesh, before);
  const LayerPlaces places = layer_places(world(), mesh);
  bool flipped = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_layer_cell(places, before.triangles[t])) {
      EXPECT_EQ(mesh.triangles[t], before.triangles[t]);
    }
    flipped = flipped || mesh.triangles[t] != before.triangles[t];
  }
  EXPECT_TRUE(world().any(flipped));
}

TEST(BlocksForFlips, AreOneEachInLayersAndAsTheyWereElsewhere) {
  const Mesh mesh = spread(strip_of_triangles.mesh());
  const LayerPlaces places = layer_places(world(), mesh);
  const std::vector<std::int32_t> given(mesh.triangles.size(), 3);
  const std::vector<std::int32_t> blocks = blocks_for_flips(world(), mesh, places, given);
  std::vector<std::int32_t> of_layers;
  for (std::size_t t = 0; t < blocks.size(); ++t) {
    if (is_layer_cell(places, mesh.triangles[t])) {
      of_layers.push_back(blocks[t]);
    } else {
      EXPECT_EQ(blocks[t], 3);
    }
  }
  const auto all = world().all_gather_values(std::span<const std::int32_t>(of_layers));
  EXPECT_EQ(all.size(), 72U);
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), 72U);
  for (const std::int32_t block : all) EXPECT_LT(block, 0);
}

TEST(BlocksForFlips, AreOneEachBesideStripsToo) {
  Mesh whole = strip_of_triangles.mesh();
  StripLayers strip{"wake", {1, 2}, false, 3, {}};
  for (std::int32_t i = 2; i <= 6; ++i) {
    for (std::int32_t j = 4; j <= 6; ++j) strip.nodes.push_back(whole.global(strip_of_triangles.node(i, j)));
  }
  whole.strips = {strip};
  const Mesh mesh = spread(whole);
  const LayerPlaces places = layer_places(world(), mesh);
  const std::vector<std::int32_t> blocks = blocks_for_flips(world(), mesh, places, {});
  for (std::size_t t = 0; t < blocks.size(); ++t) {
    const auto& nodes = mesh.triangles[t];
    const bool beside = std::ranges::any_of(nodes, [&](NodeId n) { return places[n].strip >= 0; });
    EXPECT_EQ(blocks[t] < 0, beside || is_layer_cell(places, nodes)) << t;
  }
}

}  // namespace
}  // namespace quadloop::smoother
