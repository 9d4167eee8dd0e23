// 3D files of Fluent: what the reader accepts and what it refuses by line, and which way faces look in what
// is written.
#include <gtest/gtest.h>
#include <mpi.h>

#include "io/fluent/fluent_file.hpp"
#include "io/mesh_file.hpp"
#include "io/model/check_mesh3d.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"

namespace quadloop::io {
namespace {

using test::replaced;

/// A tetrahedron on the slanted side of another: the first cell's corner at the origin, the second's at
/// (1, 1, 1). The line numbers below count in it. Each face looks into its first cell.
const std::string two_cells =
    "(0 \"two\")\n(2 3)\n(10 (0 1 5 1 3))\n(10 (1 1 5 1 3)(\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n))\n"  // 1-10
    "(12 (0 1 2 0))\n(12 (2 1 1 1 2))\n(12 (3 2 2 1 2))\n(13 (0 1 7 0))\n"      // 11-14
    "(13 (4 1 1 2 3)(\n2 3 4 2 1\n))\n"                                         // 15-17
    "(13 (5 2 4 3 3)(\n1 2 3 1 0\n1 4 2 1 0\n1 3 4 1 0\n))\n"                   // 18-22
    "(13 (a 5 7 7 0)(\n3 5 3 2 2 0\n3 5 2 4 0 2\n3 5 4 3 2 0\n))\n"             // 23-27
    "(45 (2 fluid inner)())\n(45 (3 fluid outer)())\n(45 (5 wall floor)())\n";  // 28-30

struct Read {
  FileMesh operator()(const std::string& text) const {
    const test::TemporaryFolder folder;
    test::write_bytes(folder.file("m.msh"), text);
    std::optional<FileMesh> mesh = test::read_mesh3d(folder.file("m.msh"));
    if (!mesh) throw InputError("no 3D mesh");
    return std::move(*mesh);
  }
};
const Read read;

void expect_refusal(const std::string& text, const std::string& line, const std::string& why) {
  try {
    read(text);
    ADD_FAILURE() << "is read: " << why;
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(line), std::string::npos) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find(why), std::string::npos) << refusal.what();
  }
}

TEST(FluentMesh3dReader, ReadsCellsZonesAndConditions) {
  const FileMesh mesh = read(replaced(two_cells, "3 5 2 4 0 2", "3 5 4 2 0 2"));  // looks out of its cell
  EXPECT_EQ(mesh.points.at(4), (Point3{1, 1, 1}));
  EXPECT_EQ(mesh.tetrahedra.size(), 2);
  const Mesh3dStatistics statistics = check_mesh3d(mesh);
  EXPECT_TRUE(statistics.faults.empty()) << statistics.faults.front().what;
  EXPECT_NEAR(statistics.volume, 0.5, 1e-15);
  EXPECT_EQ(mesh.block_names, (std::vector<std::string>{"inner", "outer"}));
  EXPECT_EQ(blocks_of_cells(mesh), (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(mesh.boundaries.size(), 2);
  EXPECT_EQ(mesh.boundaries[0].name, "floor");
  EXPECT_EQ(mesh.boundaries[0].condition, BoundaryCondition::wall);
  EXPECT_EQ(mesh.boundaries[0].faces.front(),
            (FileBoundary::Face{2, 1, 0, FileBoundary::no_node}));  // looks out
  EXPECT_EQ(mesh.boundaries[1].name, "zone_10");
  EXPECT_EQ(mesh.boundaries[1].condition, BoundaryCondition::symmetry);
}

TEST(FluentMesh3dReader, RefusesWhatItCannotRead) {
  expect_refusal(replaced(two_cells, "3 5 3 2 2 0", "5 5 3 2 2 1 2 0"), "m.msh:24:", "a face of 5 nodes");
  expect_refusal(replaced(two_cells, "(5 2 4 3 3)", "(5 2 4 3 2)"), "m.msh:18:", "faces of 2 nodes");
  expect_refusal(replaced(two_cells, "1 2 3 1 0", "0 2 3 1 0"), "m.msh:19:", "names node 0");
  expect_refusal(replaced(two_cells, "1 2 3 1 0", "1 2 6 1 0"),
                 "m.msh:19:", "node 6 is none of the nodes 1 to 5");
  expect_refusal(replaced(two_cells, "1 2 3 1 0", "1 2 3 2 0"), "m.msh:16:", "cell 1 has 3 triangles");
  expect_refusal(replaced(two_cells, "1 1 5 1 3)(", "1 1 5 1 2)("), "m.msh:4:", "nodes of 2 dimensions");
  expect_refusal(replaced(two_cells, "(12 (0", "(58 (0"), "m.msh:11:", "hanging nodes");
  expect_refusal(replaced(two_cells, "1 1 1\n))", "1 1 z\n))"), "m.msh:9:", "expected a z coordinate");
}

TEST(FluentMesh3dReader, RefusesFilesThatEndEarly) {
  for (std::size_t end = two_cells.find("(45") - 2; end > 0; --end)
    EXPECT_ANY_THROW(read(two_cells.substr(0, end))) << end;
}

TEST(FluentMesh3dReader, TellsTheDimensions) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder.file("m.msh"), replaced(two_cells, "(2 3)", "(2 2)"));
  EXPECT_THROW(read_fluent(folder.file("m.msh")), InputError) << "its nodes are of three";
  test::write_bytes(folder.file("m.msh"), replaced(two_cells, "(2 3)\n", ""));
  EXPECT_THROW(read_fluent(folder.file("m.msh")), InputError) << "without a word on dimensions two are meant";
  test::write_bytes(folder.file("m.msh"), two_cells);
  EXPECT_EQ(std::get<FileMesh>(read_fluent(folder.file("m.msh"))).dimension, 3);
}

/// One cube: the faces of its sides, back and front look into it.
TEST(FluentMesh3dFile, FacesLookIntoTheirFirstCell) {
  const test::TemporaryFolder folder;
  Mesh plane;
  plane.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  plane.owned_nodes = 4;
  plane.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  plane.boundaries = {{"a wall", "wall", {}}};
  for (int i = 0; i < 4; ++i) plane.boundaries[0].edges.push_back({NodeId{i}, NodeId{(i + 1) % 4}});
  const Communicator alone(MPI_COMM_SELF);
  OutputSet outputs(alone);
  write_mesh(outputs, extruded(plane, {0, 1}, ExtrusionAxis::z), folder.file("a.fluent.msh"));
  outputs.commit();
  const std::string text = test::bytes_of(folder.file("a.fluent.msh"));
  EXPECT_NE(text.find("(2 3)\n(10 (0 1 8 0 3))\n"), std::string::npos) << text;
  EXPECT_NE(text.find("(12 (2 1 1 1 4))\n(13 (0 1 6 0))\n"), std::string::npos) << text;
  EXPECT_NE(text.find("(13 (4 1 4 3 4)(\n2 4 3 1 1 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("))\n(13 (5 5 5 7 4)(\n1 3 5 7 1 0\n))\n(13 (6 6 6 7 4)(\n8 6 4 2 1 0\n))\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("(45 (2 fluid domain)())\n(45 (4 wall a_wall)())\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace quadloop::io
