// What is put right in a mesh before it is smoothed, and what is left for others to report.
#include "io/model/tidy_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/mesh/check/validate.hpp"
#include "tests/mesh/mixed_square.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

using test::node;

LoadedMesh square() {
  LoadedMesh loaded;
  loaded.mesh = test::mixed_square();
  loaded.triangle_to_block.assign(4, 0);
  loaded.quad_to_block.assign(2, 0);
  return loaded;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_TRUE(a.points == b.points);
  EXPECT_TRUE(a.triangles == b.triangles);
  EXPECT_TRUE(a.quads == b.quads);
  EXPECT_EQ(a.owned_nodes, b.owned_nodes);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t i = 0; i < a.boundaries.size(); ++i) {
    EXPECT_EQ(a.boundaries[i].name, b.boundaries[i].name);
    EXPECT_TRUE(a.boundaries[i].edges == b.boundaries[i].edges) << a.boundaries[i].name;
  }
}

TEST(TidyMesh, LeavesAGoodMeshAlone) {
  LoadedMesh loaded = square();
  tidy_mesh(loaded, "m.mesh");
  expect_same(loaded.mesh, square().mesh);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(TidyMesh, DropsNodesOfNoCellWithTheirRows) {
  LoadedMesh loaded = square();
  const auto one_later = [](auto& rows) {
    for (auto& row : rows) {
      for (NodeId& n : row) n = node(n.value() < 2 ? n.value() : n.value() + 1);
    }
  };
  Mesh& mesh = loaded.mesh;
  mesh.points.insert(mesh.points.begin() + 2, {5, 5});
  mesh.points.push_back({6, 6});
  mesh.owned_nodes = 11;
  one_later(mesh.triangles);
  one_later(mesh.quads);
  for (BoundaryEdges& b : mesh.boundaries) one_later(b.edges);
  loaded.solution = Field{{"a", "b"}, {}, {}};
  for (int i = 0; i < 22; ++i) loaded.solution->values.push_back(i);
  const auto strip = [](std::vector<int> nodes) {
    StripLayers made{"wake", {1, 0.5}, false, 3, {}};
    for (const int node : nodes) made.nodes.emplace_back(node);
    return made;
  };
  mesh.strips = {strip({0, 1, 3, 4, 5, 6}), strip({0, 1, 2, 4, 5, 6})};
  tidy_mesh(loaded, "m.mesh");
  EXPECT_EQ(mesh.strips, std::vector{strip({0, 1, 2, 3, 4, 5})}) << "one with a node of no cell is none";
  expect_same(mesh, square().mesh);
  EXPECT_EQ(loaded.solution->values,
            (std::vector<double>{0, 1, 2, 3, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"m.mesh: left out 2 nodes without a cell"});
}

TEST(TidyMesh, TurnsCellsAndBoundaryEdges) {
  LoadedMesh loaded = square();
  for (auto& t : loaded.mesh.triangles) std::swap(t[1], t[2]);
  for (auto& q : loaded.mesh.quads) std::swap(q[1], q[3]);
  std::swap(loaded.mesh.boundaries[1].edges[2][0], loaded.mesh.boundaries[1].edges[2][1]);
  tidy_mesh(loaded, "m.mesh");
  expect_same(loaded.mesh, square().mesh);
  ASSERT_EQ(loaded.warnings.size(), 2U);
  EXPECT_EQ(loaded.warnings[0], "m.mesh: reversed 6 cells with clockwise nodes");
  EXPECT_EQ(loaded.warnings[1], "m.mesh: reversed 1 boundary edge with the cell to the right");
}

TEST(TidyMesh, InvertedCellsStay) {
  LoadedMesh loaded = square();
  loaded.mesh.points[4] = {2.5, 1.5};
  const Mesh before = loaded.mesh;
  tidy_mesh(loaded, "m.mesh");
  expect_same(loaded.mesh, before);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(TidyMesh, EdgesOfNoBoundaryBecomeOne) {
  LoadedMesh loaded = square();
  loaded.mesh.boundaries[0].edges.erase(loaded.mesh.boundaries[0].edges.begin());
  loaded.mesh.boundaries[1].edges.clear();
  loaded.mesh.boundaries[0].name = "boundary";
  tidy_mesh(loaded, "m.mesh");
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  const BoundaryEdges& added = loaded.mesh.boundaries[1];
  EXPECT_EQ(added.name, "boundary_2");
  EXPECT_EQ(added.edges.size(), 5U);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  ASSERT_EQ(loaded.warnings.size(), 2U);
  EXPECT_EQ(loaded.warnings[0], "m.mesh: left out 1 named boundary curve without edges");
  EXPECT_EQ(loaded.warnings[1], "m.mesh: added 5 outer edges without a boundary, as boundary \"boundary_2\"");
}

TEST(TidyMesh, AMeshWithoutBoundariesGetsOne) {
  LoadedMesh loaded = square();
  loaded.mesh.boundaries.clear();
  tidy_mesh(loaded, "m.mesh");
  ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "boundary");
  EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 8U);
}

TEST(TidyMesh, EdgesInsideABlockBecomeInnerCurves) {
  for (const std::int32_t blocks : {1, 2}) {
    LoadedMesh loaded = square();
    loaded.blocks = blocks;
    loaded.quad_to_block.assign(2, blocks - 1);
    loaded.mesh.boundaries[0].edges.insert(loaded.mesh.boundaries[0].edges.begin(), {node(4), node(7)});
    loaded.mesh.boundaries.push_back({"between", "none", {{node(4), node(3)}}});
    const Mesh before = square().mesh;
    tidy_mesh(loaded, "m.mesh");
    EXPECT_EQ(loaded.mesh.boundaries[0].edges, before.boundaries[0].edges);
    EXPECT_EQ(loaded.mesh.boundaries.size(), blocks == 1 ? 2U : 3U);
    ASSERT_EQ(loaded.inner_curves.size(), blocks == 1 ? 2U : 1U);
    EXPECT_EQ(loaded.inner_curves[0].name, "wall");
    EXPECT_EQ(loaded.inner_curves[0].edges, (std::vector{std::array{node(4), node(7)}}));
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("not to boundaries: 'wall'"), std::string::npos);
  }
}

TEST(TidyMesh, FaultsWithoutASingleCureStay) {
  LoadedMesh loaded = square();
  loaded.mesh.triangles.push_back(loaded.mesh.triangles[0]);
  loaded.triangle_to_block.push_back(0);
  loaded.mesh.boundaries[0].edges.push_back({node(0), node(8)});  // of no cell
  const Mesh before = loaded.mesh;
  tidy_mesh(loaded, "m.mesh");
  expect_same(loaded.mesh, before);
}

}  // namespace
}  // namespace quadloop::io
