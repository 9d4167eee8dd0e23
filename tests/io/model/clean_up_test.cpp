// Meshes of other programs on their way in. On one rank alone.
#include "io/model/clean_up.hpp"

#include <gtest/gtest.h>

#include "io/model/loaded_mesh.hpp"
#include "tests/io/input/temporary_file.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

using test::node;

/// Two unit squares side by side, nodes row by row, and the text that they come from.
struct Foreign {
  Foreign() {
    mesh.dimension = 2;
    for (const double y : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0, 2.0}) mesh.points.push_back({x, y, 0});
    }
  }
  void add_squares(const std::string& left, const std::string& right) {
    add_cell<CellKind::quad>(mesh, std::array{0, 1, 4, 3}, mesh.block_named(left));
    add_cell<CellKind::quad>(mesh, std::array{1, 2, 5, 4}, mesh.block_named(right));
  }
  void add_edge(const std::string& boundary, std::int32_t a, std::int32_t b, std::size_t place = 0) {
    FileBoundary& to = mesh.boundaries[mesh.boundary_named(boundary)];
    to.faces.push_back({a, b, FileBoundary::no_node, FileBoundary::no_node});
    to.places.push_back(place);
  }
  LoadedMesh finished() { return plane_mesh(mesh, scan); }

  test::InputFolder folder;
  TextScanner scan{folder.write("a.msh", "one\ntwo\nthree\n")};
  FileMesh mesh;
};

using Edges = std::vector<std::array<NodeId, 2>>;

TEST(CleanUp, EdgesRunWithTheirCellToTheLeft) {
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

TEST(CleanUp, BetweenBlocksTheSmallerNumberLiesToTheLeft) {
  for (const bool turned : {false, true}) {
    Foreign f;
    f.add_squares("a", "b");
    f.add_edge("between", turned ? 4 : 1, turned ? 1 : 4);
    EXPECT_EQ(f.finished().mesh.boundaries[0].edges, (Edges{{node(1), node(4)}}));
  }
}

TEST(CleanUp, EdgesInsideABlockAreLeftOutWithTheirBoundary) {
  Foreign f;
  f.add_squares("a", "a");
  f.add_edge("inner", 1, 4);
  f.add_edge("wall", 0, 1);
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.mesh.boundaries[0].name, "wall");
  ASSERT_EQ(mesh.warnings.size(), 1U);
  EXPECT_NE(mesh.warnings[0].find("1 edge between two cells belongs to inner lines"), std::string::npos);
}

TEST(CleanUp, WithoutABoundaryAllOuterEdgesAreOne) {
  Foreign f;
  f.add_squares("a", "b");
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.mesh.boundaries[0].name, "boundary");
  EXPECT_EQ(mesh.mesh.boundaries[0].edges.size(), 6U);
}

TEST(CleanUp, AnEdgeOfNoCellIsRefusedByItsLine) {
  Foreign f;
  f.add_squares("a", "a");
  f.add_edge("wall", 0, 5, 4);  // "two" begins there
  const std::string refusal = test::refusal(f.folder, [&] { f.finished(); });
  EXPECT_NE(refusal.find("a.msh:2: an edge of boundary wall, from (0, 0) to (2, 1), belongs to no cell"),
            std::string::npos)
      << refusal;
}

TEST(CleanUp, WithoutCellsThereIsNoMesh) {
  Foreign f;
  EXPECT_NE(test::refusal(f.folder, [&] { f.finished(); }).find("a mesh needs cells"), std::string::npos);
}

TEST(CleanUp, ClockwiseCellsAreTurnedAndCounted) {
  Foreign f;
  f.add_squares("a", "a");
  for (auto& quad : f.mesh.quads) std::swap(quad[1], quad[3]);
  const LoadedMesh mesh = f.finished();
  ASSERT_EQ(mesh.warnings.size(), 1U);
  EXPECT_NE(mesh.warnings[0].find("reversed 2 cells with clockwise nodes"), std::string::npos);
}

TEST(CleanUp, CellsAreSortedByBlockAndEmptyBlocksGo) {
  Foreign f;
  f.mesh.block_named("empty");
  f.add_squares("a", "b");
  std::swap(f.mesh.quads[0], f.mesh.quads[1]);
  std::swap(f.mesh.cell_to_block[1][0], f.mesh.cell_to_block[1][1]);
  const LoadedMesh mesh = f.finished();
  EXPECT_EQ(mesh.blocks, 2);
  EXPECT_EQ(mesh.block_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mesh.quad_to_block, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh.mesh.quads[0][0], node(0));
  EXPECT_EQ(cells_of_block(mesh.mesh.quads, mesh.quad_to_block, 1).size(), 1U);
  EXPECT_TRUE(cells_of_block(mesh.mesh.quads, mesh.quad_to_block, 2).empty());
}

TEST(CleanUp, RepeatedElementsStandOnce) {
  Foreign f;
  f.add_squares("a", "b");
  add_cell<CellKind::quad>(f.mesh, std::array{3, 0, 1, 4}, f.mesh.block_named("b"));
  f.add_edge("wall", 0, 1);
  f.add_edge("again", 1, 0);
  drop_repeated(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.quads.size(), 2U);
  EXPECT_EQ(f.mesh.cell_to_block[1], (std::vector<std::int32_t>{0, 1})) << "the first was used";
  EXPECT_EQ(f.mesh.boundaries[0].faces.size(), 1U);
  EXPECT_TRUE(f.mesh.boundaries[1].faces.empty());
  EXPECT_EQ(f.mesh.warnings, (std::vector<std::string>{
                                 "a.msh: 1 element in the groups 'a' and 'b', assigned to 'a'",
                                 "a.msh: 1 element in the groups 'wall' and 'again', assigned to 'wall'"}));
}

TEST(CleanUp, OfRepeatedElementsThoseOfTheSmallestGroupStay) {
  Foreign f;
  f.add_squares("a", "b");
  add_cell<CellKind::quad>(f.mesh, std::array{3, 0, 1, 4}, f.mesh.block_named("c"));
  f.mesh.solution = Field{{}, {}, {}, {{"p"}, {1, 2, 3}}};
  f.add_edge("wall", 0, 1);
  f.add_edge("inlet", 1, 0);
  drop_repeated(f.mesh, "a.msh", {{5, 1}, {5, 5, 1}});
  EXPECT_EQ(f.mesh.cell_to_block[1], (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(f.mesh.solution->cells.values, (std::vector<double>{2, 3}));
  EXPECT_TRUE(f.mesh.boundaries[0].faces.empty());
  EXPECT_EQ(f.mesh.boundaries[1].faces.size(), 1U) << "inlet";
}

TEST(CleanUp, UnusedNodesGoAndTheOthersKeepTheirOrder) {
  Foreign f;
  add_cell<CellKind::triangle>(f.mesh, std::array{2, 5, 4}, f.mesh.block_named("a"));
  f.add_edge("wall", 2, 5);
  f.mesh.periodic_nodes = {0, 5};
  drop_unused_nodes(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.points.size(), 3U);
  EXPECT_EQ(f.mesh.points[1], (Point3{1, 1, 0}));
  EXPECT_EQ(f.mesh.triangles[0], (std::array{0, 2, 1}));
  EXPECT_EQ(f.mesh.boundaries[0].faces[0], (FileBoundary::Face{0, 2, -1, -1}));
  EXPECT_EQ(f.mesh.periodic_nodes, (std::vector<std::int32_t>{2}));
  EXPECT_EQ(f.mesh.warnings.size(), 1U);
  drop_unused_nodes(f.mesh, "a.msh");
  EXPECT_EQ(f.mesh.warnings.size(), 1U) << "nothing is left to be dropped";
}

TEST(CleanUp, NodesAtOnePlaceBecomeTheFirstWithItsValues) {
  Foreign f;
  f.mesh.points.push_back({1, 0, 0});  // node 6, where node 1 is
  add_cell<CellKind::triangle>(f.mesh, std::array{0, 1, 4}, f.mesh.block_named("a"));
  add_cell<CellKind::triangle>(f.mesh, std::array{6, 5, 4}, f.mesh.block_named("a"));
  f.mesh.solution = Field{{"p"}, {0, 1, 2, 3, 4, 5, 6}, {}, {}};
  unite_nodes(f.mesh);
  EXPECT_EQ(f.mesh.points.size(), 6U);
  EXPECT_EQ(f.mesh.triangles[1], (std::array{1, 5, 4}));
  EXPECT_EQ(f.mesh.solution->values, (std::vector<double>{0, 1, 2, 3, 4, 5}));
}

TEST(CleanUp, LinkedZonesUniteTheirListedNodesAlone) {
  FileMesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {0, 1e-9, 0}, {1, 0, 0},
                 {0, -1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  add_cell<CellKind::triangle>(mesh, std::array{0, 1, 2}, mesh.block_named("a"));
  add_cell<CellKind::triangle>(mesh, std::array{3, 5, 4}, mesh.block_named("b"));
  add_cell<CellKind::triangle>(mesh, std::array{6, 7, 8}, mesh.block_named("c"));
  const std::vector<std::size_t> first_nodes{0, 3, 6};
  unite_nodes(mesh, first_nodes, {{{3, 0}}, {{0, 1}}});  // nodes 1 and 4 are a crack, 1 and 6 are not linked
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 4, 3}, {1, 5, 6}}));
  EXPECT_EQ(mesh.points.size(), 7U);
  EXPECT_EQ(mesh.points[0].y, 0);
}

TEST(CleanUp, FacesOfTwoZonesAreInside) {
  FileMesh mesh;
  mesh.boundaries = {{"a", {}, {{0, 1, 2, -1}, {0, 1, 3, -1}}}, {"b", {}, {{2, 1, 0, -1}}}};
  drop_inner_faces(mesh);
  EXPECT_EQ(mesh.boundaries[0].faces, (std::vector<FileBoundary::Face>{{0, 1, 3, -1}}));
  EXPECT_TRUE(mesh.boundaries[1].faces.empty());
}

TEST(CleanUp, GroupsWithoutElementsGo) {
  FileMesh mesh;
  mesh.block_named("none");
  mesh.boundary_named("empty");
  mesh.boundaries[mesh.boundary_named("wall")].faces.push_back({0, 1, 2, -1});
  add_cell<CellKind::prism>(mesh, std::array{0, 1, 2, 3, 4, 5}, mesh.block_named("b"));
  add_cell<CellKind::tetrahedron>(mesh, std::array{0, 1, 2, 6}, mesh.block_named("a"));
  drop_empty_groups(mesh);
  EXPECT_EQ(mesh.block_names, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(mesh.cell_to_block[static_cast<std::size_t>(CellKind::prism)], (std::vector<std::int32_t>{0}));
  EXPECT_EQ(mesh.cell_to_block[static_cast<std::size_t>(CellKind::tetrahedron)],
            (std::vector<std::int32_t>{1}));
  ASSERT_EQ(mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.boundaries[0].name, "wall");
}

}  // namespace
}  // namespace quadloop::io
