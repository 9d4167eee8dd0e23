// UGRID of two dimensions: what the reader accepts, what it refuses by line. It works on one rank alone.
#include "io/ugrid/ugrid_plane_file.hpp"

#include <gtest/gtest.h>

#include "io/ugrid/ugrid_file.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using test::replaced;

const test::ReaderCheck check{test::read_plane<read_ugrid_plane>, "m.ugrid"};

/// A unit square as a quad with a triangle on top; the line numbers below count in it.
const std::string house =
    "5 1 1 0 0 0 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 1.5 0\n"         // 1-6
    "4 3 5\n1 2 3 4\n1\n1\n5\n1 2 1\n2 3 7\n3 5 7\n5 4 7\n4 1 7\n";  // 7-16

TEST(UgridPlane, ReadsCellsAndEdges) {
  const LoadedMesh loaded = check.of(house);
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points.at(4), (Point{0.5, 1.5}));
  EXPECT_EQ(loaded.mesh.quads.at(0), (std::array{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "boundary_1");
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "boundary_7");
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 4U);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(UgridPlane, CellsWithDifferentIdentifiersAreBlocks) {
  const LoadedMesh loaded = check.of(replaced(house, "1 2 3 4\n1\n1\n", "1 2 3 4\n9\n4\n"));
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"block_4", "block_9"}));
  EXPECT_EQ(loaded.triangle_to_block, std::vector<std::int32_t>{1});
  EXPECT_EQ(loaded.quad_to_block, std::vector<std::int32_t>{0});
  EXPECT_EQ(check.of(house).block_names, std::vector<std::string>{"domain"});
}

TEST(UgridPlane, EdgesMayBeMissing) {
  const LoadedMesh loaded = check.of(house.substr(0, house.find("5\n1 2 1")));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 5U);
}

TEST(UgridPlane, NamesStandInTheMapbc) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder.file("m.ugrid"), house);
  test::write_bytes(folder.file("m.mapbc"), "2\n1 4000 floor\n7 5000 walls\n");
  const LoadedMesh loaded = test::read_plane<read_ugrid_plane>(folder.file("m.ugrid"));
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "floor");
  EXPECT_EQ(loaded.mesh.boundaries[0].condition, BoundaryCondition::viscous_wall);
  EXPECT_EQ(loaded.mesh.boundaries[1].condition, BoundaryCondition::farfield);
  test::write_bytes(folder.file("m.ugrid.mapbc"), "2\n1 0 own\n7 5000 walls\n");
  EXPECT_EQ(test::read_plane<read_ugrid_plane>(folder.file("m.ugrid")).mesh.boundaries[0].name, "own");
}

TEST(UgridPlane, RefusesWhatItCannotRead) {
  check.expect_refusal(replaced(house, "1 1 0 0", "1 1 9 0"),
                       "m.ugrid:1:", "a mesh of three dimensions in text");
  check.expect_refusal(replaced(house, "4 3 5", "4 3 6"), "m.ugrid:7:", "node 6 is none of the nodes 1 to 5");
  check.expect_refusal(replaced(house, "5 1 1 0", "5000 1 1 0"), "m.ugrid:1:", "nodes");
  check.expect_refusal(replaced(house, "1 2 1\n", "1 3 1\n"), "m.ugrid:12:", "belongs to no cell");
}

TEST(UgridPlane, WallsOfTwoKindsHaveNumbersOfFun3d) {
  EXPECT_EQ(mapbc_condition("viscous_wall"), 4000);
  EXPECT_EQ(mapbc_condition("inviscid_wall"), 3000);
  EXPECT_EQ(condition_of_mapbc(4000), BoundaryCondition::viscous_wall);
  EXPECT_EQ(mapbc_path("a.b8.ugrid"), "a.mapbc");
  EXPECT_EQ(mapbc_path("a.ugrid"), "a.mapbc");
  EXPECT_EQ(mapbc_path("a"), "a.mapbc");
  EXPECT_EQ(mapbc_path("A.B8.UGRID"), "A.mapbc");
  EXPECT_EQ(plane_mapbc_path("a.ugrid"), "a.ugrid.mapbc");
}

}  // namespace
}  // namespace quadloop::io
