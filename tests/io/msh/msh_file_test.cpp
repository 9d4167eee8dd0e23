// The reader of Gmsh's files: what it accepts and puts right, and what it refuses by line. It works on one
// rank alone.
#include "io/msh/msh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::node;
using test::replaced;
using test::TemporaryFolder;

const test::ReaderCheck check{test::read_plane<read_msh>, "m.msh"};

/// A unit square as a quad with a triangle on top, tags with gaps, a node of no cell; the line numbers below
/// count in it.
const std::string old_house =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"                                                     // 1-3
    "$PhysicalNames\n3\n1 7 \"ground floor\"\n1 8 \"walls\"\n2 9 \"room\"\n$EndPhysicalNames\n"  // 4-9
    "$Nodes\n6\n10 0 0 3\n20 1 0 3\n30 1 1 3\n99 5 5 3\n40 0 1 3\n5 0.5 1.5 3\n$EndNodes\n"      // 10-18
    "$Elements\n8\n1 15 2 0 1 10\n2 1 2 7 1 10 20\n3 1 2 8 2 20 30\n"                            // 19-25
    "4 1 2 8 2 30 5\n5 1 2 8 3 5 40\n"
    "6 1 2 8 3 40 10\n7 3 2 9 1 10 20 30 40\n8 2 2 9 1 40 30 5\n$EndElements\n";  // 26-29

/// The same in version 4.1, with parameters of nodes and without the node of no cell.
const std::string new_house =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"                                                     // 1-3
    "$PhysicalNames\n3\n1 7 \"ground floor\"\n1 8 \"walls\"\n2 9 \"room\"\n$EndPhysicalNames\n"  // 4-9
    "$Entities\n1 3 1 0\n1 0 0 3 0\n1 0 0 3 1 0 3 1 7 2 1 -2\n2 0 0 3 1 2 3 1 8 2 2 -3\n3 0 0 3 1 2 3 1 -8 "
    "0\n"                                        // 10-15
    "1 0 0 3 1 2 3 1 9 3 1 2 3\n$EndEntities\n"  // 16-17
    "$Nodes\n2 5 5 40\n1 1 1 2\n10\n20\n0 0 3 0.5\n1 0 3 0.75\n2 1 0 3\n30\n40\n5\n1 1 3\n0 1 3\n0.5 1.5 "
    "3\n$EndNodes\n"  // 18-32
    "$Elements\n6 8 1 8\n0 1 15 1\n1 10\n1 1 1 1\n2 10 20\n1 2 1 2\n3 20 30\n4 30 5\n1 3 1 2\n5 5 40\n6 40 "
    "10\n"                                                         // 33-44
    "2 1 3 1\n7 10 20 30 40\n2 1 2 1\n8 40 30 5\n$EndElements\n";  // 45-49

void expect_house(const LoadedMesh& loaded) {
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 1.5}}));
  EXPECT_EQ(loaded.mesh.quads.at(0), (std::array{node(0), node(1), node(2), node(3)}));
  EXPECT_EQ(loaded.mesh.triangles.at(0), (std::array{node(3), node(2), node(4)}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "ground floor");
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "walls");
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 4U);
  EXPECT_EQ(loaded.block_names, std::vector<std::string>{"room"});
}

std::vector<std::string> boundary_names(const LoadedMesh& loaded) {
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) names.push_back(boundary.name);
  return names;
}

TEST(MshReader, MarksPeriodicNodes) {
  const std::vector<NodeId> sides{node(1), node(0), node(2), node(3)};
  EXPECT_EQ(check.of(old_house + "$Periodic\n1\n1 2 3\n2\n20 10\n30 40\n$EndPeriodic\n").periodic_nodes,
            sides);
  EXPECT_EQ(check
                .of(old_house + "$Periodic\n2\n0 1 2\nAffine 1 0 0 1\n1\n99 99\n1 2 3\nAffine 1 0 0 1\n2\n20 "
                                "10\n30 40\n$EndPeriodic\n")
                .periodic_nodes,
            sides);
  EXPECT_EQ(
      check.of(new_house + "$Periodic\n1\n1 2 3\n4 1 0 0 1\n2\n20 10\n30 40\n$EndPeriodic\n").periodic_nodes,
      sides);
  EXPECT_EQ(check.of(new_house + "$Periodic\n1\n1 2 3\n0\n2\n20 10\n30 40\n$EndPeriodic\n").periodic_nodes,
            sides);
  EXPECT_TRUE(check.of(new_house).periodic_nodes.empty());
}

TEST(MshReader, ReadsBothVersions) {
  expect_house(check.of(old_house));
  expect_house(check.of(new_house));
  expect_house(check.of(test::with_crlf(old_house)));
  expect_house(check.of(test::with_crlf(new_house)));
  EXPECT_EQ(check.of(old_house).warnings.size(), 1U);  // the node of no cell
  EXPECT_TRUE(check.of(new_house).warnings.empty());
}

/// Of nodes or elements, in the order of the rows given.
std::string values(const std::string& kind, const std::string& name, int width, int rows,
                   const std::string& text) {
  return "$" + kind + "\n1\n\"" + name + "\"\n1\n0.5\n4\n0\n" + std::to_string(width) + "\n" +
         std::to_string(rows) + "\n0\n" + text + "$End" + kind + "\n";
}

TEST(MshReader, ReadsValuesAtNodesAndInElements) {
  const std::string data =
      values("NodeData", "my p", 1, 5, "5 50\n40 40\n30 30\n20 20\n10 10.5\n") +
      values("ElementData", "q", 1, 2, "8 2.5\n7 1.5\n") +
      values("NodeData", "u", 3, 6, "10 1 -1 0\n20 2 -2 0\n99 9 9 9\n30 3 -3 0\n40 4 -4 0\n5 5 -5 0\n") +
      values("ElementData", "w", 3, 8,
             "1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n5 0 0 0\n6 0 0 0\n7 1 2 3\n8 4 5 6\n");
  for (const bool old : {true, false}) {
    const LoadedMesh loaded = check.of((old ? old_house : new_house) + data);
    expect_house(loaded);
    ASSERT_TRUE(loaded.solution);
    EXPECT_EQ(loaded.solution->names, (std::vector<std::string>{"my p", "u_x", "u_y"}));
    EXPECT_EQ(loaded.solution->values,
              (std::vector<double>{10.5, 1, -1, 20, 2, -2, 30, 3, -3, 40, 4, -4, 50, 5, -5}));
    EXPECT_EQ(loaded.solution->cells.names, (std::vector<std::string>{"q", "w_x", "w_y", "w_z"}));
    EXPECT_EQ(loaded.solution->cells.values, (std::vector<double>{2.5, 4, 5, 6, 1.5, 1, 2, 3}));
    EXPECT_EQ(loaded.warnings.size(), old ? 1U : 0U);
  }
}

TEST(MshReader, SaysWhichValuesItLeavesOut) {
  const LoadedMesh loaded =
      check.of(new_house + values("NodeData", "p", 1, 2, "10 1\n5 1\n") +
               values("ElementData", "q", 1, 1, "7 1\n") + values("ElementNodeData", "r", 1, 0, ""));
  EXPECT_FALSE(loaded.solution);
  ASSERT_EQ(loaded.warnings.size(), 3U);
  EXPECT_NE(loaded.warnings[0].find("1 sections $ElementNodeData"), std::string::npos);
  EXPECT_NE(loaded.warnings[1].find("'p' has no values for 3 of the 5 nodes"), std::string::npos);
  EXPECT_NE(loaded.warnings[2].find("'q' has no values for 1 of the 2 cells"), std::string::npos);
}

TEST(MshReader, TakesTheLastOfSeveralSteps) {
  const LoadedMesh loaded = check.of(new_house + values("ElementData", "q", 1, 2, "7 1\n8 2\n") +
                                     values("ElementData", "q", 1, 2, "7 3\n8 4\n"));
  ASSERT_TRUE(loaded.solution);
  EXPECT_EQ(loaded.solution->cells.values, (std::vector<double>{4, 3}));
}

TEST(MshReader, RefusesDamagedValues) {
  const std::string data = values("ElementData", "q", 1, 2, "7 1\n8 2\n");
  check.expect_refusal(new_house + replaced(data, "8 2", "8 nan"), "m.msh:61: ", "not finite");
  check.expect_refusal(new_house + replaced(data, "\n1\n2\n", "\n2\n2\n"), "m.msh:57: ", "components");
  check.expect_refusal(new_house + replaced(data, "8 2\n", ""), "m.msh:", "");
  check.expect_refusal(new_house + replaced(data, "8 2\n", "8 2\n9 3\n"), "m.msh:62: ", "row too many");
  check.expect_refusal(new_house + replaced(data, "\n4\n0\n", "\n2\n0\n"), "m.msh:", "three integers");
}

TEST(MshReader, PassesOverOtherSections) {
  const std::string comments = "$Comments\n# 1 % any $Nodes\n$EndComments\n";
  const std::string periodic = "$Periodic\n1\n0 2 1\n1\n2 1\n$EndPeriodic\n";
  expect_house(check.of(comments + old_house + periodic));
  const std::string new_periodic = "$Periodic\n1\n0 2 1\n0\n1\n2 1\n$EndPeriodic\n";
  expect_house(check.of(replaced(new_house, "$Elements", new_periodic + "$Elements")));
}

TEST(MshReader, TurnsCellsAndEdges) {
  std::string turned = replaced(old_house, "40 30 5\n$End", "5 30 40\n$End");
  turned = replaced(replaced(turned, " 10 20 30 40\n", " 10 40 30 20\n"), " 10 20\n", " 20 10\n");
  const LoadedMesh loaded = check.of(turned);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.boundaries.at(0).edges, check.of(old_house).mesh.boundaries.at(0).edges);
  EXPECT_NE(loaded.warnings.back().find("reversed 2 cells with clockwise nodes"), std::string::npos);
}

TEST(MshReader, NamesWhatHasNoName) {
  const std::string names =
      old_house.substr(old_house.find("$Phys"), old_house.find("$Nodes") - old_house.find("$Phys"));
  EXPECT_EQ(boundary_names(check.of(replaced(old_house, names, ""))),
            (std::vector<std::string>{"physical_7", "physical_8"}));
  std::string no_groups = replaced(replaced(old_house, "2 7 1", "2 0 1"), "9 1 10", "0 1 10");
  for (int i = 0; i < 4; ++i) no_groups = replaced(no_groups, "1 2 8 ", "1 2 0 ");
  EXPECT_EQ(boundary_names(check.of(no_groups)),
            (std::vector<std::string>{"boundary_1", "boundary_2", "boundary_3"}));
  EXPECT_NE(check.of(no_groups).warnings.back().find(
                "m.msh: 3 curves are in no physical group; their boundaries are called boundary_"),
            std::string::npos);
  EXPECT_EQ(check.of(replaced(no_groups, "2 9 1 40", "2 0 1 40")).block_names,
            std::vector<std::string>{"domain"});
}

TEST(MshReader, MakesOneBoundaryWhereNoLinesAre) {
  const std::size_t lines = old_house.find("2 1 2 7"), cells = old_house.find("7 3 2 9");
  const std::string bare =
      replaced(old_house.substr(0, lines) + old_house.substr(cells), "$Elements\n8", "$Elements\n3");
  const LoadedMesh loaded = check.of(bare);
  EXPECT_EQ(boundary_names(loaded), std::vector<std::string>{"boundary"});
  EXPECT_TRUE(validate(loaded.mesh).empty());
  const LoadedMesh inner =
      check.of(replaced(replaced(bare, "ments\n3", "ments\n4"), "$EndEl", "9 1 2 7 1 40 30\n$EndEl"));
  EXPECT_EQ(boundary_names(inner), std::vector<std::string>{"boundary"});
}

TEST(MshReader, LeavesOutLinesInsideABlock) {
  const LoadedMesh loaded =
      check.of(replaced(replaced(old_house, "ments\n8", "ments\n9"), "$EndEl", "9 1 2 8 4 40 30\n$EndEl"));
  expect_house(loaded);
  EXPECT_NE(loaded.warnings.back().find("1 edge between two cells belongs to inner lines"),
            std::string::npos);
}

TEST(MshReader, KeepsBlocksApart) {
  std::string two = replaced(old_house, "2 2 9 1 40", "2 2 10 2 40");
  two = replaced(replaced(two, "ments\n8", "ments\n9"), "$EndEl", "9 1 2 11 4 30 40\n$EndEl");
  const LoadedMesh loaded = check.of(two);
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"room", "physical_10"}));
  EXPECT_EQ(loaded.triangle_to_block, std::vector<std::int32_t>{1});
  EXPECT_EQ(boundary_names(loaded).back(), "physical_11");
  EXPECT_EQ(loaded.mesh.boundaries.back().edges.at(0),
            (std::array{node(2), node(3)}));  // the first block to its left
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
}

/// The top is pulled down into the room below, which is another block: its triangle is inverted, not turned.
TEST(MshReader, LeavesInvertedCellsToValidate) {
  const std::string two =
      replaced(replaced(old_house, "2 2 9 1 40", "2 2 10 2 40"), "5 0.5 1.5", "5 0.5 0.5");
  for (const std::string& text :
       {two, replaced(replaced(two, "40 30 5\n$End", "40 5 30\n$End"), " 10 20 30 40\n", " 10 40 30 20\n")}) {
    const LoadedMesh loaded = check.of(text);
    EXPECT_EQ(loaded.mesh.quads, check.of(old_house).mesh.quads);
    EXPECT_EQ(loaded.mesh.triangles, check.of(old_house).mesh.triangles);
    EXPECT_EQ(loaded.mesh.boundaries.at(1).edges, check.of(old_house).mesh.boundaries.at(1).edges);
    const std::vector<MeshFault> faults =
        validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block});
    EXPECT_TRUE(std::any_of(faults.begin(), faults.end(),
                            [](const MeshFault& fault) { return fault.rule == MeshRule::positive; }));
  }
}

/// Two triangles, then a third, in blocks that alternate.
TEST(MshReader, SortsCellsByBlock) {
  const LoadedMesh loaded = check.of(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 -1 0 "
      "0\n$EndNodes\n"
      "$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 2 2 1 3 4\n3 2 2 1 3 1 4 5\n$EndElements\n");
  EXPECT_EQ(loaded.triangle_to_block, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(loaded.mesh.triangles.at(1), (std::array{node(0), node(3), node(4)}));
  EXPECT_EQ(loaded.blocks, 2);
}

TEST(MshReader, TakesAnElementOfTwoGroupsOnce) {
  const std::string again = "9 1 2 8 1 10 20\n10 2 2 12 1 40 30 5\n$EndEl";
  const LoadedMesh loaded = check.of(replaced(replaced(old_house, "ments\n8", "ments\n10"), "$EndEl", again));
  expect_house(loaded);
  ASSERT_EQ(loaded.warnings.size(), 3U);  // the last is on the node of no cell
  EXPECT_NE(loaded.warnings[0].find("1 element in the groups 'ground floor' and 'walls', assigned to "
                                    "'ground floor'"),
            std::string::npos)
      << loaded.warnings[0];
  EXPECT_NE(loaded.warnings[1].find("'room' and 'physical_12'"), std::string::npos) << loaded.warnings[1];
}

/// The left wall is a part of all walls, which the file lists first: the smaller group keeps its name.
TEST(MshReader, TakesTheSmallestOfSeveralGroups) {
  const std::string old_overlap = replaced(replaced(old_house, "ments\n8", "ments\n9"), "$EndEl",
                                           "9 1 2 7 3 40 10\n$EndEl");  // curve 3: 8, then 7
  const LoadedMesh old = check.of(replaced(old_overlap, "2 1 2 7 1 10 20", "2 1 2 8 1 10 20"));
  EXPECT_EQ(old.mesh.boundaries.at(1).name, "ground floor");
  EXPECT_EQ(old.mesh.boundaries[1].edges, (std::vector<std::array<NodeId, 2>>{{node(3), node(0)}}));
  std::string new_overlap = new_house;
  for (const auto& [from, to] : {std::pair{"3 1 7 2 1 -2", "3 1 8 2 1 -2"},
                                 {"3 1 8 2 2 -3", "3 2 8 7 2 2 -3"},
                                 {" 3 1 -8 ", " 3 2 8 7 "}})
    new_overlap = replaced(new_overlap, from, to);
  const LoadedMesh both = check.of(new_overlap);
  EXPECT_EQ(both.mesh.boundaries.at(0).name, "walls");
  EXPECT_EQ(both.mesh.boundaries.at(0).edges.size(), 1U);
  EXPECT_EQ(both.mesh.boundaries.at(1).name, "ground floor");
  ASSERT_EQ(both.warnings.size(), 1U);
  EXPECT_NE(
      both.warnings[0].find("m.msh: curve 2 is in the physical groups 'walls' and 'ground floor' and is "
                            "assigned to 'ground floor', the smallest; likewise 1 more curves"),
      std::string::npos)
      << both.warnings[0];
}

TEST(MshReader, NamesTheGroupsThatItLeavesOut) {
  const std::string probe =
      replaced(replaced(old_house, "Names\n3", "Names\n4"), "1 7 ", "0 3 \"probe\"\n1 7 ");
  EXPECT_NE(check.of(probe).warnings.at(1).find("physical groups of points are left out: 'probe'"),
            std::string::npos);
  const std::string inner =
      replaced(replaced(replaced(probe, "Names\n4", "Names\n5"), "1 7 ", "1 9 \"fracture\"\n1 7 "),
               "ments\n8", "ments\n9");
  EXPECT_NE(check.of(replaced(inner, "$EndEl", "9 1 2 9 4 40 30\n$EndEl"))
                .warnings.back()
                .find("1 edge between two cells belongs to inner lines, not to boundaries: 'fracture'"),
            std::string::npos);
}

TEST(MshReader, ReadsNodesWithParameters) {
  std::string text = old_house;
  for (const auto& [from, to] : {std::pair{"$Nodes", "$ParametricNodes"},
                                 {"$EndNodes", "$EndParametricNodes"},
                                 {"10 0 0 3\n", "10 0 0 3 0 1\n"},
                                 {"20 1 0 3\n", "20 1 0 3 1 2 0.5\n"}})
    text = replaced(text, from, to);
  expect_house(check.of(text));
}

TEST(MshReader, RefusesWrongCounts) {
  check.expect_refusal(replaced(old_house, "Nodes\n6", "Nodes\n5"), "m.msh:17: ", "a row too many");
  check.expect_refusal(replaced(old_house, "Nodes\n6", "Nodes\n7"), "m.msh:18: ", "$EndNodes");
  check.expect_refusal(replaced(old_house, "Nodes\n6", "Nodes\n-6"), "m.msh:11: ", "negative");
  check.expect_refusal(replaced(old_house, "Nodes\n6", "Nodes\n2000000000"), "m.msh:11: ", "cut short");
  check.expect_refusal(replaced(old_house, "ments\n8", "ments\n7"), "m.msh:28: ", "a row too many");
  check.expect_refusal(replaced(old_house, "ments\n8", "ments\n9"), "m.msh:29: ", "$EndElements");
  check.expect_refusal(replaced(old_house, "Names\n3", "Names\n2"), "m.msh:8: ", "a row too many");
  check.expect_refusal(replaced(new_house, "2 5 5 40", "2 6 5 40"), "m.msh:", "5 nodes, not 6");
  check.expect_refusal(replaced(new_house, "6 8 1 8", "6 9 1 8"), "m.msh:", "8 elements, not 9");
  check.expect_refusal(replaced(new_house, "6 8 1 8", "5 8 1 8"), "m.msh:", "7 elements, not 8");
  check.expect_refusal(old_house + "$Nodes\n0\n$EndNodes\n", "m.msh:30: ", "second section");
}

TEST(MshReader, RefusesBadRowsByLine) {
  check.expect_refusal(replaced(old_house, "40 30 5\n$", "40 30 6\n$"), "m.msh:28: ", "node 6");
  check.expect_refusal(replaced(new_house, "8 40 30 5", "8 40 30 0"), "m.msh:48: ", "node 0");
  check.expect_refusal(replaced(old_house, "30 1 1 3", "30 1 nan 3"), "m.msh:14: ", "nan");
  check.expect_refusal(replaced(old_house, "30 1 1 3", "30 1 1 4"), "m.msh:14: ", "plane");
  check.expect_refusal(replaced(old_house, "30 1 1 3", "10 1 1 3"), "m.msh:", "two nodes have the tag 10");
  check.expect_refusal(replaced(old_house, "8 2 20 30", "8 2 20 5"),
                       "m.msh:23: ", "walls, from (1, 0) to (0.5, 1.5), belongs to no cell");
  check.expect_refusal(replaced(old_house, "2 7 1", "2 70000000000 1"), "m.msh:22: ", "physical group");
}

TEST(MshReader, RefusesWhatItDoesNotKnow) {
  check.expect_refusal(replaced(old_house, "7 3 2 9 1", "7 4 2 9 1"), "m.msh: ", "contains a 3D mesh");
  check.expect_refusal(replaced(old_house, "8 2 2 9 1", "8 9 2 9 1"), "m.msh:28: ", "ElementOrder = 1");
  check.expect_refusal(replaced(new_house, "2 1 3 1", "2 1 16 1"),
                       "m.msh:45: ", "16 (quadrilateral of second order");
  check.expect_refusal(replaced(old_house, "2.2 0 8", "4 0 8"), "m.msh:2: ", "version 4;");
  check.expect_refusal(replaced(old_house, "2.2 0 8", "2.2 1 8"), "m.msh:2: ", "binary");
  check.expect_refusal("$PartitionedEntities\n" + new_house, "m.msh:1: ", "partitioned");
  check.expect_refusal("", "m.msh:1: ", "no MSH file");
  check.expect_refusal(old_house.substr(0, old_house.find("7 3 2 9")) + "$EndElements\n", "m.msh:", "");
  check.expect_refusal(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n",
      "m.msh:", "needs cells");
}

TEST(MshReader, RefusesEarlyEnd) {
  check.expect_early_ends_refused(old_house);
  check.expect_early_ends_refused(new_house);
}

TEST(MshWriter, KeepsNamesInQuotes) {
  const TemporaryFolder folder;
  Mesh mesh = test::sample_mesh(2);
  mesh.boundaries[0].name = "5\" tube";
  mesh.boundaries.push_back({"nothing", "none", {}});
  test::write_alone(test::world(), mesh, folder.file("m.msh"));
  EXPECT_EQ(boundary_names(test::read_plane<read_msh>(folder.file("m.msh"))),
            (std::vector<std::string>{"5' tube", "far field"}));
}

}  // namespace
}  // namespace quadloop::io
