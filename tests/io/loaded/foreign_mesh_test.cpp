// Meshes of other programs on their way in. On one rank alone.
#include "io/loaded/foreign_mesh.hpp"

#include <gtest/gtest.h>

#include "io/loaded/loaded_mesh.hpp"
#include "tests/io/input/temporary_file.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop {
namespace {

using test::node;

/// Two unit squares side by side, nodes row by row, and the text that they come from.
struct Foreign {
  Foreign() {
    for (const double y : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0, 2.0}) mesh.loaded.mesh.points.push_back({x, y});
    }
  }
  void add_squares(const std::string& left, const std::string& right) {
    mesh.add_quad({node(0), node(1), node(4), node(3)}, mesh.block_named(left));
    mesh.add_quad({node(1), node(2), node(5), node(4)}, mesh.block_named(right));
  }
  void add_edge(const std::string& boundary, std::int32_t a, std::int32_t b, std::size_t place = 0) {
    mesh.edges.push_back({{node(a), node(b)}, mesh.boundary_named(boundary), place});
  }
  LoadedMesh finished() { return finish(mesh, scan); }

  test::InputFolder folder;
  TextScanner scan{folder.write("a.msh", "one\ntwo\nthree\n")};
  ForeignMesh mesh;
};

using Edges = std::vector<std::array<NodeId, 2>>;

TEST(ForeignMesh, EdgesRunWithTheirCellToTheLeft) {
  Foreign f;
  f.add_squares("a", "a");
  f.add_edge("wall", 0, 1);
  f.add_edge("wall", 2, 1);  // the wrong way
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.mesh.boundaries[0].edges, (Edges{{node(0), node(1)}, {node(1), node(2)}}));
  EXPECT_EQ(mesh.mesh.owned_nodes, 6);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(ForeignMesh, BetweenBlocksTheSmallerNumberLiesToTheLeft) {
  for (const bool turned : {false, true}) {
    Foreign f;
    f.add_squares("a", "b");
    f.add_edge("between", turned ? 4 : 1, turned ? 1 : 4);
    EXPECT_EQ(f.finished().mesh.boundaries[0].edges, (Edges{{node(1), node(4)}}));
  }
}

TEST(ForeignMesh, EdgesInsideABlockAreLeftOutWithTheirBoundary) {
  Foreign f;
  f.add_squares("a", "a");
  f.add_edge("inner", 1, 4);
  f.add_edge("wall", 0, 1);
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.mesh.boundaries[0].name, "wall");
  ASSERT_EQ(mesh.warnings.size(), 1U);
  EXPECT_NE(mesh.warnings[0].find("1 edges between two cells"), std::string::npos);
}

TEST(ForeignMesh, WithoutABoundaryAllOuterEdgesAreOne) {
  Foreign f;
  f.add_squares("a", "b");
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.mesh.boundaries[0].name, "boundary");
  EXPECT_EQ(mesh.mesh.boundaries[0].edges.size(), 6U);
}

TEST(ForeignMesh, AnEdgeOfNoCellIsRefusedByItsLine) {
  Foreign f;
  f.add_squares("a", "a");
  f.add_edge("wall", 0, 5, 4);  // "two" begins there
  const std::string refusal = test::refusal(f.folder, [&] { f.finished(); });
  EXPECT_NE(refusal.find("a.msh:2: an edge of boundary wall, from (0, 0) to (2, 1), belongs to no cell"),
            std::string::npos)
      << refusal;
}

TEST(ForeignMesh, WithoutCellsThereIsNoMesh) {
  Foreign f;
  EXPECT_NE(test::refusal(f.folder, [&] { f.finished(); }).find("a mesh needs cells"), std::string::npos);
}

TEST(ForeignMesh, ClockwiseCellsAreTurnedAndCounted) {
  Foreign f;
  f.add_squares("a", "a");
  for (auto& quad : f.mesh.loaded.mesh.quads) std::swap(quad[1], quad[3]);
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.warnings.size(), 1U);
  EXPECT_NE(mesh.warnings[0].find("2 cells ran clockwise"), std::string::npos);
}

TEST(ForeignMesh, CellsAreSortedByBlockAndEmptyBlocksGo) {
  Foreign f;
  f.mesh.block_named("empty");
  f.add_squares("a", "b");
  std::swap(f.mesh.loaded.mesh.quads[0], f.mesh.loaded.mesh.quads[1]);
  std::swap(f.mesh.loaded.quad_to_block[0], f.mesh.loaded.quad_to_block[1]);
  const LoadedMesh mesh = f.finished();
  EXPECT_EQ(mesh.blocks, 2);
  EXPECT_EQ(mesh.block_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mesh.quad_to_block, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh.mesh.quads[0][0], node(0));
  EXPECT_EQ(cells_of_block(mesh.mesh.quads, mesh.quad_to_block, 1).size(), 1U);
  EXPECT_TRUE(cells_of_block(mesh.mesh.quads, mesh.quad_to_block, 2).empty());
}

TEST(ForeignMesh, RepeatedElementsStandOnce) {
  Foreign f;
  f.add_squares("a", "b");
  f.mesh.add_quad({node(3), node(0), node(1), node(4)}, f.mesh.block_named("b"));
  f.add_edge("wall", 0, 1);
  f.add_edge("again", 1, 0);
  drop_repeated(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.loaded.mesh.quads.size(), 2U);
  EXPECT_EQ(f.mesh.loaded.quad_to_block, (std::vector<std::int32_t>{0, 1})) << "the first was taken";
  EXPECT_EQ(f.mesh.edges.size(), 1U);
  EXPECT_EQ(f.mesh.loaded.warnings,
            (std::vector<std::string>{
                "a.msh: 1 elements are in the groups 'a' and 'b'; they are taken for 'a'",
                "a.msh: 1 elements are in the groups 'wall' and 'again'; they are taken for 'wall'"}));
}

TEST(ForeignMesh, OfRepeatedElementsThoseOfTheSmallestGroupStay) {
  Foreign f;
  f.add_squares("a", "b");
  f.mesh.add_quad({node(3), node(0), node(1), node(4)}, f.mesh.block_named("c"));
  f.mesh.loaded.solution = Field{{}, {}, {}, {{"p"}, {1, 2, 3}}};
  f.add_edge("wall", 0, 1);
  f.add_edge("inlet", 1, 0);
  drop_repeated(f.mesh, "a.msh", {{5, 1}, {5, 5, 1}});
  EXPECT_EQ(f.mesh.loaded.quad_to_block, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(f.mesh.loaded.solution->cells.values, (std::vector<double>{2, 3}));
  ASSERT_EQ(f.mesh.edges.size(), 1U);
  EXPECT_EQ(f.mesh.loaded.mesh.boundaries[f.mesh.edges[0].boundary].name, "inlet");
}

TEST(ForeignMesh, UnusedNodesGoAndTheOthersKeepTheirOrder) {
  Foreign f;
  f.mesh.add_triangle({node(2), node(5), node(4)}, f.mesh.block_named("a"));
  f.add_edge("wall", 2, 5);
  drop_unused_nodes(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.loaded.mesh.points.size(), 3U);
  EXPECT_EQ(f.mesh.loaded.mesh.point(node(1)), (Point{1, 1}));
  EXPECT_EQ(f.mesh.loaded.mesh.triangles[0], (std::array{node(0), node(2), node(1)}));
  EXPECT_EQ(f.mesh.edges[0].nodes, (std::array{node(0), node(2)}));
  EXPECT_EQ(f.mesh.loaded.warnings.size(), 1U);
  drop_unused_nodes(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.loaded.warnings.size(), 1U) << "nothing is left to be dropped";
}

}  // namespace
}  // namespace quadloop
