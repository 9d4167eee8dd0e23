// Where the mesh outside is too coarse for columns to stand on it.
#include "mesher/layers/unsound_strips.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/build/build_mesh.hpp"
#include "tests/layers/walls.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::ten_layers;
using test::world;

/// The mesh outside of a floor's layers.
struct Outside {
  explicit Outside(Geometry g) : geometry{std::move(g)}, front{layer_front(geometry)} {
    MeshOptions options;
    options.size.min = 0.05;
    options.size.max = 1;
    result = build_mesh(world(), front.outer, options);
  }
  std::vector<UnsoundStrip> unsound() const {
    return unsound_strips(world(), front, result.mesh, result.edge_leaves);
  }
  Geometry geometry;
  LayerFront front;
  MeshResult result;
};

TEST(UnsoundStrips, ThereAreNoneWhereLayersCanStand) {
  for (const Geometry& g : {test::floor_with_layers(ten_layers), test::step_with_layers(ten_layers),
                            test::rhombus_with_layers(ten_layers, 0.25)})
    EXPECT_TRUE(Outside(g).unsound().empty());
}

TEST(UnsoundStrips, AreTheEdgesWithColumnsUpsideDown) {
  Outside outside(test::floor_with_layers(ten_layers));
  for (Point& p : outside.result.mesh.points) {
    if (p.y < 0.52 && std::abs(p.x - 4) < 1) p.y = -0.1;  // below the wall
  }
  const std::vector<UnsoundStrip> found = outside.unsound();
  EXPECT_GT(world().sum(std::ssize(found)), 0);
  for (const UnsoundStrip& strip : found) {
    const Mesh& mesh = outside.result.mesh;
    EXPECT_TRUE(mesh.point(strip.edge[0]).y < 0 || mesh.point(strip.edge[1]).y < 0);
  }
}

TEST(UnsoundStrips, AreThoseWhoseFeetPassOverAHeadland) {
  // Without its tip as a node a chord of the front may begin on one side of the needle and end on the other.
  Outside outside(test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                                    {{"needle", {{-2, 0}, {2, 0.1}, {2, -0.1}}, ten_layers}}}));
  Mesh& mesh = outside.result.mesh;
  EXPECT_TRUE(outside.unsound().empty());
  BoundaryEdges& edges = mesh.boundaries[1];
  if (world().size() > 1 || edges.edges.empty()) return;
  const auto is_left = [&](NodeId node) { return mesh.point(node).x < -1.5; };
  std::array<NodeId, 2> across{};
  for (const auto& edge : edges.edges) {  // from the last one before the tip to the first one behind it
    if (!is_left(edge[0]) && is_left(edge[1])) across[0] = edge[0];
    if (is_left(edge[0]) && !is_left(edge[1])) across[1] = edge[1];
  }
  edges.edges = {across};
  outside.result.edge_leaves[1] = {0};
  const std::vector<UnsoundStrip> found = outside.unsound();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].edge, across);
  EXPECT_FALSE(found[0].stations.empty());
}

TEST(UnsoundStrips, AreThoseAtANodeWhereTheFrontTouchesItself) {
  Outside outside(test::floor_with_layers(ten_layers));
  Mesh& mesh = outside.result.mesh;
  auto& edges = mesh.boundaries[0].edges;
  if (world().size() > 1) return;
  ASSERT_GT(edges.size(), 4U);
  edges.push_back(edges[2]);
  outside.result.edge_leaves[0].push_back(outside.result.edge_leaves[0][2]);
  EXPECT_GE(outside.unsound().size(), 2U);
}

TEST(LayerFront, StationsThatAreKeptAreNodes) {
  const Geometry geometry = test::floor_with_layers(ten_layers);
  LayerFront front = layer_front(geometry);
  const std::int32_t station = front.line.size() / 2;
  front.keep({station});
  std::int32_t kept = 0;
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    if (front.station_of[s] == station) kept += front.outer.kept(s);
  }
  EXPECT_EQ(kept, 1);
}

}  // namespace
}  // namespace quadloop
