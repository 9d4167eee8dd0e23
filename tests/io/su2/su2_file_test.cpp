// The SU2 reader: what it accepts and puts right, and what it refuses by line. It works on one rank alone.
#include "io/su2/su2_file.hpp"

#include <gtest/gtest.h>

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

const test::ReaderCheck check{test::read_plane<read_su2>, "m.su2"};

/// A unit square as a quad with a triangle on top; the line numbers below count in it.
const std::string house =
    "NDIME= 2\nNELEM= 2\n9 0 1 2 3 0\n5 3 2 4 1\n"                       // 1-4
    "NPOIN= 5\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n0.5 1.5 4\n"                  // 5-10
    "NMARK= 2\nMARKER_TAG= floor\nMARKER_ELEMS= 1\n3 0 1\n"              // 11-14
    "MARKER_TAG= walls\nMARKER_ELEMS= 4\n3 1 2\n3 2 4\n3 4 3\n3 3 0\n";  // 15-20

TEST(Su2Reader, ReadsCellsAndMarkers) {
  const LoadedMesh loaded = check.of(house);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points.at(4), (Point{0.5, 1.5}));
  EXPECT_EQ(loaded.mesh.quads.at(0), (std::array{node(0), node(1), node(2), node(3)}));
  EXPECT_EQ(loaded.mesh.triangles.at(0), (std::array{node(3), node(2), node(4)}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "floor");
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 4U);
  EXPECT_EQ(loaded.mesh.owned_nodes, 5);
  EXPECT_EQ(loaded.blocks, 1);
  EXPECT_EQ(loaded.triangle_to_block.size(), 1U);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Su2Reader, TurnsCellsAndEdges) {
  const std::string turned = replaced(replaced(house, "9 0 1 2 3", "9 0 3 2 1"), "3 0 1\n", "3 1 0\n");
  const LoadedMesh loaded = check.of(turned);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.quads, check.of(house).mesh.quads);
  EXPECT_EQ(loaded.mesh.boundaries[0].edges, check.of(house).mesh.boundaries[0].edges);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("reversed 1 cell with clockwise nodes"), std::string::npos);
}

TEST(Su2Reader, TakesKeysInAnyOrderAndSpacing) {
  const std::string elements = "NELEM= 2\n9 0 1 2 3 0\n5 3 2 4 1\n", head = "NDIME= 2\n";
  const std::string last = "\t NELEM =2 % two\n\n% a comment = none\n 9 0 1 2 3\n5  3 2\t4\nNDIME=2";
  std::string moved = replaced(replaced(house, elements, ""), head, "") + last;
  EXPECT_EQ(check.of(moved).mesh.quads, check.of(house).mesh.quads);
  moved = replaced(replaced(moved, "0.5 1.5 4", "+.5 1.5D0 % top"), "NPOIN= 5", "NPOIN= 5 5");
  EXPECT_EQ(check.of(moved).mesh.points, check.of(house).mesh.points);
  EXPECT_EQ(check.of(test::with_crlf(house)).mesh.boundaries.at(0).name, "floor");
  EXPECT_EQ(check.of(replaced(house, "= floor", "=   first floor  % name")).mesh.boundaries.at(0).name,
            "first floor");
}

TEST(Su2Reader, PassesOverWhatIsNoMesh) {
  const std::string box = "FFD_NBOX= 1\nFFD_TAG= 0\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n";
  EXPECT_TRUE(validate(check.of(replaced(house, "NPOIN", box + "NPOIN")).mesh).empty());
  EXPECT_TRUE(validate(check.of(house + box).mesh).empty());
}

TEST(Su2Reader, MakesBoundariesOfMarkers) {
  const LoadedMesh one = check.of(replaced(house, "= walls", "= floor"));
  ASSERT_EQ(one.mesh.boundaries.size(), 1U);
  EXPECT_EQ(one.mesh.boundaries[0].edges.size(), 5U);
  const LoadedMesh none = check.of(house.substr(0, house.find("NMARK")));
  ASSERT_EQ(none.mesh.boundaries.size(), 1U);
  EXPECT_EQ(none.mesh.boundaries[0].name, "boundary");
  EXPECT_TRUE(validate(none.mesh).empty());
  const LoadedMesh inner = check.of(replaced(house, "ELEMS= 1\n", "ELEMS= 2\n3 3 2\n"));
  EXPECT_EQ(inner.mesh.boundaries.at(0).edges.size(), 1U);
  EXPECT_EQ(inner.warnings.size(), 1U);
}

TEST(Su2Reader, RefusesWrongCounts) {
  check.expect_refusal(replaced(house, "NPOIN= 5", "NPOIN= 4"), "m.su2:10: ", "a row too many");
  check.expect_refusal(replaced(house, "NPOIN= 5", "NPOIN= 6"), "m.su2:11: ", "NMARK");
  check.expect_refusal(replaced(house, "NPOIN= 5", "NPOIN= -5"), "m.su2:5: ", "negative");
  check.expect_refusal(replaced(house, "NPOIN= 5", "NPOIN= 2000000000"), "m.su2:5: ", "cut short");
  check.expect_refusal(replaced(house, "NPOIN= 5", "NPOIN="), "m.su2:5: ", "number of points");
  check.expect_refusal(replaced(house, "NELEM= 2", "NELEM= 1"), "m.su2:4: ", "a row too many");
  check.expect_refusal(replaced(house, "NELEM= 2", "NELEM= 3"), "m.su2:5: ", "NPOIN");
  check.expect_refusal(replaced(house, "NELEM= 2", "NELEM= two"), "m.su2:2: ", "two");
  check.expect_refusal(replaced(house, "NMARK= 2", "NMARK= 3"), "m.su2:11: ", "2 markers");
  check.expect_refusal(replaced(house, "ELEMS= 1\n", "ELEMS= 2\n"), "m.su2:15: ", "MARKER_TAG");
  check.expect_refusal(replaced(house, "ELEMS= 4\n", "ELEMS= 3\n"), "m.su2:20: ", "a row too many");
  check.expect_refusal(replaced(house, "MARKER_ELEMS= 1\n3 0 1\n", ""),
                       "m.su2:13: ", "floor has no MARKER_ELEMS");
  check.expect_refusal(replaced(house, "MARKER_TAG= walls\n", ""), "m.su2:15: ", "without a MARKER_TAG");
  check.expect_refusal(house + "NELEM= 0\n", "m.su2:21: ", "a second time");
  check.expect_refusal("9 9\n" + house, "m.su2:1: ", "KEY= value");
}

TEST(Su2Reader, RefusesBadRowsByLine) {
  check.expect_refusal(replaced(house, "5 3 2 4", "5 3 2 5"), "m.su2:4: ", "point 5");
  check.expect_refusal(replaced(house, "3 0 1", "3 0 -1"), "m.su2:14: ", "point -1");
  check.expect_refusal(replaced(house, "1 1 2\n", "1 nan 2\n"), "m.su2:8: ", "nan");
  check.expect_refusal(replaced(house, "1 1 2\n", "1\n"), "m.su2:8: ", "this line ends");
  check.expect_refusal(replaced(house, "9 0 1 2 3 0", "9 0 1 2"), "m.su2:3: ", "this line ends");
  check.expect_refusal(replaced(house, "3 2 4\n", "3 0 4\n"),
                       "m.su2:18: ", "walls, from (0, 0) to (0.5, 1.5), belongs to no cell");
}

TEST(Su2Reader, RefusesWhatItDoesNotKnow) {
  check.expect_refusal(replaced(house, "9 0 1 2 3", "10 0 1 2 3"), "m.su2:3: ", "tetrahedron");
  check.expect_refusal(replaced(house, "9 0 1 2 3", "66 0 1 2 3"), "m.su2:3: ", "type 66;");
  check.expect_refusal(replaced(house, "3 0 1\n", "1 0\n"),
                       "m.su2:14: ", "marker floor has an element of type 1 (vertex)");
  check.expect_refusal(replaced(house, "NDIME= 2", "NDIME= 1"), "m.su2:1: ", "1 dimensions");
  check.expect_refusal(replaced(house, "5 3 2 4", "22 3 2 4 0 1 2"),
                       "m.su2:4: ", "22 (triangle of second order)");
  check.expect_refusal(replaced(house, "5 3 2 4", "105 3 2 4 0 1 2"),
                       "m.su2:4: ", "105 (triangle of order 2)");
  check.expect_refusal("NZONE= 2\n" + house, "m.su2:1: ", "1 zone (IZONE=), not 2");
  check.expect_refusal("no mesh at all\n", "m.su2:1: ", "no SU2 mesh");
  check.expect_refusal("", "m.su2:1: ", "no SU2 mesh");
  check.expect_refusal("NDIME= 2\nNELEM= 0\nNPOIN= 0\nNMARK= 0\n", "m.su2:", "needs cells");
}

TEST(Su2Reader, IgnoresWhatFollowsCoordinates) {
  const Mesh plain = check.of(house).mesh;
  const LoadedMesh numbered = check.of(replaced(house, "1 1 2\n", "1 1 2 2\n"));
  EXPECT_EQ(numbered.mesh.points, plain.points);
  EXPECT_TRUE(numbered.warnings.empty());
  const LoadedMesh in_space =
      check.of(replaced(replaced(house, "1 1 2\n", "1 1 0.5 2\n"), "0 1 3\n", "0 1 0. 3\n"));
  EXPECT_EQ(in_space.mesh.points, plain.points);
  ASSERT_EQ(in_space.warnings.size(), 1U);
  EXPECT_NE(in_space.warnings[0].find("m.su2:8: 2 rows of points"), std::string::npos)
      << in_space.warnings[0];
}

TEST(Su2Reader, PassesOverMarkersOfRanks) {
  const std::string ranks = "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_TO= 1\n1 0 1\n1 2 0\n";
  const LoadedMesh loaded = check.of(replaced(house, "NMARK= 2", "NMARK= 3") + ranks);
  EXPECT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("1 markers SEND_RECEIVE"), std::string::npos) << loaded.warnings[0];
}

TEST(Su2Reader, MakesBlocksOfZones) {
  std::string right = house;
  for (const auto& [from, to] : {std::pair{"0 0 0\n", "5 0 0\n"},
                                 {"1 0 1\n1 1 2\n0 1 3", "6 0 1\n6 1 2\n5 1 3"},
                                 {"0.5 1.5", "5.5 1.5"},
                                 {"floor", "right_floor"}})
    right = replaced(right, from, to);
  const LoadedMesh loaded = check.of("NZONE= 2\nIZONE= 1\n" + house + "IZONE= 2\n" + right);
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"zone_1", "zone_2"}));
  EXPECT_EQ(loaded.blocks, 2);
  EXPECT_EQ(loaded.mesh.points.size(), 10U);
  EXPECT_EQ(loaded.mesh.quads.at(1), (std::array{node(5), node(6), node(7), node(8)}));
  EXPECT_EQ(loaded.quad_to_block, (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 3U);
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 8U);  // the walls of both
  EXPECT_EQ(loaded.mesh.boundaries[2].name, "right_floor");
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
  check.expect_refusal("NZONE= 2\nIZONE= 1\n" + replaced(house, "NPOIN", "POIN") + "IZONE= 2\n" + right,
                       "m.su2:23: ", "a zone ends without NPOIN");
}

TEST(Su2Reader, UnitesZonesWithCommonEdges) {
  const std::string cellar =
      "NDIME= 2\nNELEM= 1\n9 0 1 2 3 0\nNPOIN= 4\n0 -1 0\n1 -1 1\n1 0 2\n0 0 3\nNMARK= 2\nMARKER_TAG= "
      "floor\nMARKER_ELEMS= 1\n3 2 3\nMARKER_TAG= ground\nMARKER_ELEMS= 3\n3 3 0\n3 0 1\n3 1 2\n";
  const std::string both = "NZONE= 2\nIZONE= 1\n" + house + "IZONE= 2\n% block cellar\n" + cellar;
  const LoadedMesh loaded = check.of(both);
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"zone_1", "cellar"}));
  EXPECT_EQ(loaded.mesh.points.size(), 7U);
  EXPECT_EQ(loaded.mesh.quads.at(1), (std::array{node(5), node(6), node(1), node(0)}));
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) {
    if (boundary.name != "floor") continue;
    EXPECT_EQ(boundary.edges, (std::vector<std::array<NodeId, 2>>{{node(0), node(1)}}));
  }
  EXPECT_EQ(check
                .of(replaced(both, "MARKER_TAG= floor\nMARKER_ELEMS= 1\n3 2",
                             "MARKER_TAG= roof\nMARKER_ELEMS= 1\n3 2"))
                .mesh.points.size(),
            9U);
}

/// A baffle from (1, 1) to (1, -1) crosses the edges that both zones have in common. In the second zone the
/// nodes of its right side come first.
TEST(Su2Reader, UnitesNodesOnEachSideOfABaffle) {
  const std::string upper =
      "NDIME= 2\nNELEM= 2\n9 0 1 2 3\n9 4 5 6 7\nNPOIN= 8\n0 0\n1 0\n1 1\n0 1\n1 0\n2 0\n2 1\n1 1\nNMARK= 4\n"
      "MARKER_TAG= interface\nMARKER_ELEMS= 2\n3 0 1\n3 4 5\nMARKER_TAG= walls\nMARKER_ELEMS= 4\n3 5 6\n3 6 "
      "7\n"
      "3 2 3\n3 3 0\nMARKER_TAG= plate\nMARKER_ELEMS= 1\n3 1 2\nMARKER_TAG= plate__right\nMARKER_ELEMS= 1\n3 "
      "7 4\n";
  const std::string lower =
      "NDIME= 2\nNELEM= 2\n9 3 2 1 0\n9 7 6 5 4\nNPOIN= 8\n1 0\n2 0\n2 -1\n1 -1\n0 0\n1 0\n1 -1\n0 "
      "-1\nNMARK= 4\n"
      "MARKER_TAG= interface\nMARKER_ELEMS= 2\n3 1 0\n3 5 4\nMARKER_TAG= walls\nMARKER_ELEMS= 4\n3 3 2\n3 2 "
      "1\n"
      "3 7 6\n3 4 7\nMARKER_TAG= plate\nMARKER_ELEMS= 1\n3 6 5\nMARKER_TAG= plate__right\nMARKER_ELEMS= 1\n3 "
      "0 3\n";
  const LoadedMesh loaded = check.of("NZONE= 2\nIZONE= 1\n" + upper + "IZONE= 2\n" + lower);
  EXPECT_EQ(loaded.mesh.points.size(), 12U);
  ASSERT_EQ(loaded.mesh.quads.size(), 4U);
  EXPECT_EQ(loaded.mesh.quads[2][2], node(5));
  EXPECT_EQ(loaded.mesh.quads[2][3], node(4)) << "on the right of the baffle";
  EXPECT_EQ(loaded.mesh.quads[3][2], node(1)) << "on its left";
  EXPECT_EQ(loaded.mesh.quads[3][3], node(0));
  EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 2U);
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
}

TEST(Su2Reader, RefusesEarlyEnd) {
  const std::size_t markers = house.find("NMARK");
  check.expect_early_ends_refused(house.substr(0, markers));
  for (std::size_t at = house.find('\n', markers) + 1; at < house.size(); at = house.find('\n', at) + 1) {
    check.expect_refusal(house.substr(0, at), "m.su2:", "");
  }
}

TEST(Su2Writer, GivesMarkersNamesThatSu2Takes) {
  const TemporaryFolder folder;
  Mesh mesh = test::sample_mesh(2);
  mesh.boundaries[0].name = "far,field";
  mesh.boundaries.push_back({"nothing", "none", {}});
  test::write_alone(test::world(), mesh, folder.file("m.su2"));
  const LoadedMesh loaded = test::read_plane<read_su2>(folder.file("m.su2"));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "far_field");
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "far_field_2");
  EXPECT_EQ(loaded.mesh.points, mesh.points);
}

}  // namespace
}  // namespace quadloop::io
