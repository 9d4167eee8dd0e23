// Medit's text: what the reader accepts and what it refuses by line; what the writer numbers. On one rank
// alone.
#include "io/medit/medit_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include "io/mesh_file.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

using test::node;
using test::replaced;

const test::ReaderCheck check{read_mesh, "m.mesh"};

/// A unit square as a quad with a triangle on top, with sections that are none of a mesh's; the line numbers
/// below count in it.
const std::string house =
    "MeshVersionFormatted 2\n# by hand\nDimension\n2\n"                            // 1-4
    "Vertices\n5\n0 0 1\n1 0 0\n1 1 0\n0 1 0\n.5 1.5d0 0\n"                        // 5-11
    "Corners 2\n1 2\nTriangles\n1\n4 3 5 7\nQuadrilaterals 1\n1 2 3 4 7\n"         // 12-18
    "RequiredVertices\n1\n5\nEdges\n5\n1 2 3\n2 3 8\n3 5 8\n5 4 8\n1 4 8\nEnd\n";  // 19-29

TEST(MeditReader, ReadsCellsAndEdgesByReference) {
  for (const std::string& text : {house, test::with_crlf(house), replaced(house, "\nEnd\n", "\n")}) {
    const LoadedMesh loaded = check.of(text);
    EXPECT_TRUE(validate(loaded.mesh).empty());
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.mesh.points.at(4), (Point{0.5, 1.5}));
    EXPECT_EQ(loaded.mesh.quads.at(0), (std::array{node(0), node(1), node(2), node(3)}));
    EXPECT_EQ(loaded.mesh.triangles.at(0), (std::array{node(3), node(2), node(4)}));
    ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
    EXPECT_EQ(loaded.mesh.boundaries[0].name, "boundary_3");
    EXPECT_EQ(loaded.mesh.boundaries[1].name, "boundary_8");
    EXPECT_EQ(loaded.mesh.boundaries[1].edges.back(), (std::array{node(3), node(0)}));
    EXPECT_EQ(loaded.block_names, std::vector<std::string>{"domain"});
  }
}

TEST(MeditReader, ReferencesOfCellsAreBlocks) {
  const LoadedMesh loaded = check.of(replaced(house, "1 2 3 4 7", "1 2 3 4 9"));
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"block_7", "block_9"}));
  EXPECT_EQ(loaded.quad_to_block, std::vector<std::int32_t>{1});
}

TEST(MeditReader, PlaneMeshesMayHaveAThirdCoordinate) {
  std::string flat = replaced(house, "Dimension\n2", "Dimension\n3");
  for (const auto& [from, to] : {std::pair{"0 0 1\n", "0 0 .5 1\n"},
                                 {"1 0 0\n", "1 0 .5 0\n"},
                                 {"1 1 0\n", "1 1 .5 0\n"},
                                 {"0 1 0\n", "0 1 .5 0\n"},
                                 {".5 1.5d0 0", ".5 1.5 .5 0"}})
    flat = replaced(flat, from, to);
  EXPECT_EQ(check.of(flat).mesh.points, check.of(house).mesh.points);
  check.expect_refusal(replaced(flat, "1 1 .5 0", "1 1 .25 0"),
                       "m.mesh:9: ", "vertex 3 does not lie in the first one's plane");
}

TEST(MeditReader, RefusesByLine) {
  check.expect_refusal(replaced(house, "1 2 3 4 7", "1 2 3 6 7"),
                       "m.mesh:18: ", "vertex 6 is none of the vertices 1 to 5");
  check.expect_refusal(replaced(house, "Vertices\n5", "Vertices\n4"), "m.mesh:11: ", "the name of a section");
  check.expect_refusal(replaced(house, "Vertices\n5", "Vertices\n5000"), "m.mesh:6: ", "cut short");
  check.expect_refusal(replaced(house, "Dimension\n2", "Dimension\n4"), "m.mesh:4: ", "4 dimensions");
  check.expect_refusal(replaced(house, "Corners 2\n1 2", "Tetrahedra 1\n1 2 3 4 0"),
                       "m.mesh:12: ", "three dimensions");
  check.expect_refusal(replaced(house, "Corners 2\n1 2", "TrianglesP2 1\n1 2 3 4 5 6 0"),
                       "m.mesh:12: ", "second order");
  check.expect_refusal("MeshVersionFormatted 2\nDimension 2\nEnd\n", "m.mesh:", "without Vertices");
}

TEST(MeditWriter, NumbersBoundariesAndBlocks) {
  EXPECT_EQ(medit_boundary_names({"wall", "boundary_1", "boundary_02", "boundary_7", "boundary_x"}),
            (std::vector<std::string>{"boundary_2", "boundary_1", "boundary_3", "boundary_7", "boundary_4"}));
  const test::TemporaryFolder folder;
  const LoadedMesh loaded = check.of(replaced(house, "1 2 3 4 7", "1 2 3 4 9"));
  write_mesh_file(Communicator(MPI_COMM_SELF), loaded, folder.file("a.mesh"), "medit");
  const LoadedMesh back = read_mesh(folder.file("a.mesh"));
  EXPECT_EQ(back.mesh.points, loaded.mesh.points);
  EXPECT_EQ(back.mesh.quads, loaded.mesh.quads);
  EXPECT_EQ(back.block_names, (std::vector<std::string>{"block_1", "block_2"}));
  ASSERT_EQ(back.mesh.boundaries.size(), 2U);
  EXPECT_EQ(back.mesh.boundaries[1].name, "boundary_8");
  EXPECT_EQ(back.mesh.boundaries[1].edges, loaded.mesh.boundaries[1].edges);
}

}  // namespace
}  // namespace quadloop::io
