// The reader of Fluent's 2D files: what it accepts and puts right, what it refuses by line; blocks as zones.
// It works on one rank alone.
#include "io/fluent/fluent_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include "io/fluent/fluent_zones.hpp"
#include "io/mesh_file.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

using test::node;
using test::replaced;

const test::ReaderCheck check{test::read_plane<read_fluent>, "m.msh"};

/// A unit square as a quad with a triangle on top; the line numbers below count in it. As other programs
/// write it: remarks and unknown sections, names at the end, a face's cells in any order, the last zone of
/// any kind of face.
const std::string house =
    "(0 \"a (remark\")\n(2 2)\n(10 (0 1 5 1 2))\n(10 (1 1 5 1 2)\n(\n0 0\n1 0 1 1\n0 1\n0.5 1.5\n))\n"  // 1-10
    "(12 (0 1 2 0))\n(12 (2 1 2 1 0)(3 1))\n(13 (0 1 6 0))\n"                      // 11-13
    "(13 (3 1 1 2 2)(\n3 4 1 2\n))\n"                                              // 14-16
    "(13 (4 2 2 3 2)(\n1 2 1 0\n))\n"                                              // 17-19
    "(13 (a 3 6 5 0)(\n2 2 3 1 0\n2 1 4 0 1\n2 3 5 2 0\n2 5 4 2 0\n))\n"           // 20-25
    "(37 ((x (y 1)) (z 2)))\n(45 (2 fluid room)())\n(45 (3 interior inside)())\n"  // 26-28
    "(39 (4 wall floor 1)(a b))\n(45 (10 pressure-outlet walls)())\n";             // 29-30

TEST(FluentReader, ReadsCellsAndZones) {
  const LoadedMesh loaded = check.of(house);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 1.5}}));
  EXPECT_EQ(loaded.mesh.quads.at(0), (std::array{node(2), node(3), node(0), node(1)}));
  EXPECT_EQ(loaded.mesh.triangles.at(0), (std::array{node(3), node(2), node(4)}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "floor");
  EXPECT_EQ(loaded.mesh.boundaries[0].condition, BoundaryCondition::wall);
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "walls");
  EXPECT_EQ(loaded.mesh.boundaries[1].condition, BoundaryCondition::outflow);
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 4U);
  EXPECT_EQ(loaded.block_names, std::vector<std::string>{"room"});
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(FluentReader, PassesOverSectionsWithoutANumber) {
  const std::string cad = "(cad/adv-options ((recursive? #f) (unit \"mm\") (note \"a ) b ( \\\" c\")))\n";
  EXPECT_EQ(check.of(cad + house).mesh.quads, check.of(house).mesh.quads);
}

TEST(FluentReader, TurnsCellsThatLieToTheRight) {
  std::string turned = replaced(replaced(house, "3 4 1 2", "4 3 1 2"), "\n1 2 1 0", "\n2 1 1 0");
  turned = replaced(replaced(turned, "2 2 3 1 0", "2 3 2 1 0"), "2 1 4 0 1", "2 4 1 0 1");
  turned = replaced(replaced(turned, "2 3 5 2 0", "2 5 3 2 0"), "2 5 4 2 0", "2 4 5 2 0");
  const LoadedMesh loaded = check.of(turned);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("reversed 2 cells with clockwise nodes"), std::string::npos);
}

TEST(FluentReader, TwoZonesOfCellsAreBlocks) {
  const std::string two =
      replaced(replaced(house, "(12 (2 1 2 1 0)(3 1))", "(12 (2 1 1 1 3)) (12 (5 2 2 1 1))"), "(37 ((x",
               "(45 (5 solid roof)())(37 ((x");
  const LoadedMesh loaded = check.of(two);
  EXPECT_EQ(loaded.blocks, 2);
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"room", "roof"}));
  EXPECT_EQ(loaded.triangle_to_block, std::vector<std::int32_t>{1});
  ASSERT_EQ(loaded.mesh.boundaries.size(), 3U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "inside");
  EXPECT_EQ(loaded.mesh.boundaries[0].condition, BoundaryCondition::interface);
}

TEST(FluentReader, RefusesWhatItCannotRead) {
  check.expect_refusal(replaced(house, "(2 2)", "(2 3)"), "m.msh:4:", "nodes of 2 dimensions");
  check.expect_refusal(replaced(house, "(10 (1 1 5", "(3010 (1 1 5"), "m.msh:4:", "binary");
  check.expect_refusal(replaced(house, "(37 ((x", "(58 ((x"), "m.msh:26:", "hanging nodes");
  check.expect_refusal(replaced(house, "(37 ((x", "(59 ((x"), "m.msh:26:", "hanging nodes");
  check.expect_refusal(replaced(house, "(4 2 2 3 2)", "(4 2 2 3 3)"), "m.msh:17:", "faces of 3 nodes");
  check.expect_refusal(replaced(house, "2 3 5 2 0", "3 3 5 2 0"), "m.msh:23:", "has not two nodes");
  check.expect_refusal(replaced(house, "\n1 2 1 0", "\n1 6 1 0"),
                       "m.msh:18:", "node 6 is none of the nodes 1 to 5");
  check.expect_refusal(replaced(house, "\n1 2 1 0", "\n1 2 ff 0"), "m.msh:", "cell 255 cannot be");
  check.expect_refusal(replaced(house, "\n1 2 1 0", "\n1 2 1 1"), "m.msh:18:", "the same cell on both sides");
  check.expect_refusal(replaced(house, "\n1 2 1 0", "\n1 5 1 0"),
                       "m.msh:15:", "the faces of cell 1 do not go round it");
  check.expect_refusal(replaced(replaced(house, "\n1 2 1 0", "\n1 2 2 0"), "2 2 3 1 0", "2 2 3 2 0"),
                       "m.msh:15:", "cell 1 has 2 faces");
  check.expect_refusal(replaced(house, "(10 (1 1 5", "(10 (1 1 5000000"), "m.msh:4:", "cannot hold its");
  check.expect_refusal(replaced(house, "0.5 1.5", "0.5 x"),
                       "m.msh:9:", "expected a y coordinate, found \"x\"");
  check.expect_refusal("(0 \"nothing\")\n", "m.msh:", "ends without nodes and faces");
}

TEST(FluentReader, RefusesFilesThatEndEarly) {
  for (std::size_t end = house.find("(37 ((x") - 2; end > 0; --end)
    EXPECT_ANY_THROW(check.of(house.substr(0, end))) << end;
}

TEST(FluentZones, ConditionsComeBack) {
  for (const BoundaryCondition condition :
       {BoundaryCondition::wall, BoundaryCondition::farfield, BoundaryCondition::inflow,
        BoundaryCondition::outflow, BoundaryCondition::symmetry, BoundaryCondition::interface})
    EXPECT_EQ(condition_of_fluent(fluent_number(condition)), condition);
  EXPECT_EQ(fluent_word("none"), "wall");
  EXPECT_EQ(condition_of_fluent(12), BoundaryCondition::none);
}

TEST(FluentFile, BlocksComeBack) {
  const test::TemporaryFolder folder;
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(4);
  Mesh& mesh = whole.mesh;
  whole.blocks = 2;
  whole.block_names = {"below", "above"};
  whole.triangle_to_block.assign(mesh.triangles.size(), 1);
  whole.quad_to_block.assign(mesh.quads.size(), 0);
  mesh.boundaries.push_back({"between", "interface", {}});
  for (const auto& [a, b, c, d] : mesh.quads) mesh.boundaries.back().edges.push_back({c, d});
  write_mesh_file(Communicator(MPI_COMM_SELF), whole, folder.file("a.fluent.msh"));
  const LoadedMesh back = read_mesh(folder.file("a.fluent.msh"));
  EXPECT_TRUE(validate(back.mesh, {back.blocks, back.triangle_to_block, back.quad_to_block}).empty());
  EXPECT_EQ(back.block_names, whole.block_names);
  EXPECT_EQ(back.triangle_to_block, whole.triangle_to_block);
  EXPECT_EQ(back.quad_to_block, whole.quad_to_block);
  ASSERT_EQ(back.mesh.boundaries.size(), 3U);
  EXPECT_EQ(back.mesh.boundaries[2].name, "between");
  EXPECT_EQ(back.mesh.boundaries[2].edges, mesh.boundaries[2].edges);
}

TEST(FluentFile, EdgesBetweenBlocksThatNoBoundaryNamesStayNone) {
  const test::TemporaryFolder folder;  // collective
  const Communicator alone(MPI_COMM_SELF);
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(4);
  whole.blocks = 2;
  whole.block_names = {"upper", "lower"};
  whole.triangle_to_block.assign(whole.mesh.triangles.size(), 0);
  whole.quad_to_block.assign(whole.mesh.quads.size(), 1);
  write_mesh_file(alone, whole, folder.file("a.fluent.msh"));
  const LoadedMesh back = read_mesh(folder.file("a.fluent.msh"));
  ASSERT_EQ(back.mesh.boundaries.size(), whole.mesh.boundaries.size());
  for (std::size_t b = 0; b < back.mesh.boundaries.size(); ++b)
    EXPECT_EQ(back.mesh.boundaries[b].edges.size(), whole.mesh.boundaries[b].edges.size());
  EXPECT_EQ(back.blocks, 2);
}

TEST(FluentFile, IsToldFromGmshsByItsFirstSign) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder.file("a.msh"), house);
  EXPECT_EQ(read_mesh(folder.file("a.msh")).mesh.quads.size(), 1U);
  test::write_bytes(folder.file("b.msh"), "$MeshFormat\n");
  EXPECT_FALSE(is_fluent(folder.file("b.msh")));
}

}  // namespace
}  // namespace quadloop::io
