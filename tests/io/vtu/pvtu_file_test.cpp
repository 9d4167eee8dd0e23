// Parallel VTK files: pieces put together, and what is refused. On one rank alone.
#include "io/vtu/pvtu_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>

#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

std::string data(const std::string& type, const std::string& name, const std::string& values,
                 int components = 1) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">" + values + "</DataArray>\n";
}

/// Quads alone, with a variable.
std::string piece(const std::string& points, const std::string& values, const std::string& quads,
                  const std::string& variable = "rho") {
  const auto count = [](const std::string& text) { return std::ranges::count(text, ' ') + 1; };
  std::string offsets, types;
  for (std::int64_t i = 1; i <= count(quads) / 4; ++i) {
    offsets += std::to_string(4 * i) + " ";
    types += "9 ";
  }
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
         "NumberOfPoints=\"" +
         std::to_string(count(points) / 3) + "\" NumberOfCells=\"" + std::to_string(count(quads) / 4) +
         "\"><PointData>" + data("Float64", variable, values) + "</PointData><Points>" +
         data("Float64", "Points", points, 3) + "</Points><Cells>" + data("Int64", "connectivity", quads) +
         data("Int64", "offsets", offsets) + data("UInt8", "types", types) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

const std::string list =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">\n<PUnstructuredGrid "
    "GhostLevel=\"1\">\n<Piece Source=\"parts/a.vtu\"/>\n<Piece "
    "Source=\"parts/b.vtu\"/>\n</PUnstructuredGrid>\n"
    "</VTKFile>\n";

/// Three unit squares in a row; the one in the middle is in both pieces.
class PvtuReader : public ::testing::Test {
 protected:
  PvtuReader() {
    std::filesystem::create_directory(folder_.file("parts"));
    write("m.pvtu", list);
    write("parts/a.vtu", piece("0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0", "1 2 3 4 5 6", "0 1 4 3 1 2 5 4"));
    write("parts/b.vtu", piece("2 1 0 3 1 0 2 0 0 3 0 0 1 0 0 1 1 0", "6 8 3 7 2 5", "4 2 0 5 2 3 1 0"));
  }
  void write(const std::string& name, const std::string& text) {
    test::write_bytes(folder_.file(name), text);
  }
  void expect_refusal(const std::string& says) {
    try {
      test::read_plane<read_pvtu>(folder_.file("m.pvtu"));
      ADD_FAILURE() << "not refused: " << says;
    } catch (const InputError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(says), std::string::npos) << refusal.what();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(PvtuReader, PutsPiecesTogether) {
  const LoadedMesh loaded = test::read_plane<read_pvtu>(folder_.file("m.pvtu"));
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points,
            (std::vector<Point>{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1}, {3, 0}}));
  EXPECT_EQ(loaded.mesh.quads.size(), 3U);
  EXPECT_EQ(loaded.solution->values, (std::vector<double>{1, 2, 3, 4, 5, 6, 8, 7}));
  ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 8U);
}

TEST_F(PvtuReader, KeepsTheValuesOfCells) {
  const auto with_cells = [&](const std::string& file, const std::string& name, const std::string& values) {
    const std::string text = test::bytes_of(folder_.file(file));
    write(file, test::replaced(text, "<Points>",
                               "<CellData>" + data("Float64", name, values) + "</CellData><Points>"));
  };
  with_cells("parts/a.vtu", "p", "0.5 0.25");
  with_cells("parts/b.vtu", "p", "0.125 8");  // its first cell is the first piece's second
  const LoadedMesh loaded = test::read_plane<read_pvtu>(folder_.file("m.pvtu"));
  EXPECT_EQ(loaded.solution->cells.names, std::vector<std::string>{"p"});
  EXPECT_EQ(loaded.solution->cells.values, (std::vector<double>{0.5, 0.25, 8}));
  EXPECT_EQ(loaded.solution->values, (std::vector<double>{1, 2, 3, 4, 5, 6, 8, 7}));
  with_cells("parts/b.vtu", "q", "0 0");
  expect_refusal("the cell data of the piece parts/b.vtu are not those of the first piece");
}

TEST_F(PvtuReader, RefusesWhatDoesNotFitTogether) {
  write("parts/b.vtu", piece("2 1 0 3 1 0 2 0 0 3 0 0", "6 8 3 7", "2 3 1 0", "p"));
  expect_refusal("the point data of the piece parts/b.vtu are not those of the first piece");
  std::filesystem::remove(folder_.file("parts/b.vtu"));
  expect_refusal("parts/b.vtu");
  write("m.pvtu", test::replaced(list, " Source=\"parts/b.vtu\"", ""));
  expect_refusal("m.pvtu:5: a piece names no file");
  write("m.pvtu", test::replaced(list, "type=\"P", "type=\"P2"));
  expect_refusal("m.pvtu:2: holds VTK data of type 'P2UnstructuredGrid'");
  write("m.pvtu", list.substr(0, list.size() / 2));
  expect_refusal("m.pvtu:");
  write("m.pvtu", "<VTKFile type=\"PUnstructuredGrid\"></VTKFile>");
  expect_refusal("no piece");
}

TEST(PvtuWriter, WritesOnePieceBesideTheList) {
  const TemporaryFolder folder;
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(3);
  whole.triangle_to_block.assign(whole.mesh.triangles.size(), 0);
  whole.quad_to_block.assign(whole.mesh.quads.size(), 0);
  write_mesh_file(Communicator(MPI_COMM_SELF), whole, folder.file("a.pvtu"));
  write_mesh_file(Communicator(MPI_COMM_SELF), whole, folder.file("a.vtu"));
  EXPECT_EQ(test::bytes_of(folder.file("a_0.vtu")), test::bytes_of(folder.file("a.vtu")));
  EXPECT_NE(test::bytes_of(folder.file("a.pvtu")).find("Source=\"a_0.vtu\""), std::string::npos);
}

}  // namespace
}  // namespace quadloop::io
