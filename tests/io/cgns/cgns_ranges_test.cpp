// A CGNS file of one zone is read by all ranks, each its ranges of the arrays, and gives the mesh, or the
// message, that one rank gives that reads all of it.
#include <cgnslib.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <mpi.h>

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "io/cgns/cgns_contents.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/mesh_file.hpp"
#include "io/model/distribute.hpp"
#include "io/native/native_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::expect_same;
using test::TemporaryFolder;
using test::world;

constexpr cgsize_t columns = 12, row = columns + 1;

/// Appends the nodes, from 1, of the squares `begin` to `end`, or of two triangles of each.
std::vector<cgsize_t> squares(cgsize_t begin, cgsize_t end) {
  std::vector<cgsize_t> nodes;
  for (cgsize_t i = begin; i < end; ++i) nodes.insert(nodes.end(), {i + 1, i + 2, row + i + 2, row + i + 1});
  return nodes;
}
std::vector<cgsize_t> halves(cgsize_t begin, cgsize_t end) {
  std::vector<cgsize_t> nodes;
  for (cgsize_t i = begin; i < end; ++i)
    nodes.insert(nodes.end(), {i + 1, i + 2, row + i + 1, i + 2, row + i + 2, row + i + 1});
  return nodes;
}

/// The file as it is written: by the serial library, on rank 0.
struct Writer {
  int file = 0, base = 0, zone = 0, at = 0;

  void section(const char* name, ElementType_t type, cgsize_t first, cgsize_t last,
               const std::vector<cgsize_t>& nodes) {
    EXPECT_EQ(cg_section_write(file, base, zone, name, type, first, last, 0, nodes.data(), &at), CG_OK)
        << cg_get_error();
  }
  template <class Value>
  void field(int solution, const char* name, DataType_t type, std::vector<Value> values) {
    EXPECT_EQ(cg_field_write(file, base, zone, solution, type, name, values.data(), &at), CG_OK);
  }
};

/// A row of squares, some divided, in sections that are not in the order of their elements, with a line
/// inside, a periodic side, a height of 0, and values of several types.
void write_row(const std::string& path) {
  Writer out;
  const std::array<cgsize_t, 3> size{2 * row, columns + 4, 0};
  cg_set_file_type(CG_FILE_HDF5);
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_WRITE, &out.file), CG_OK);
  cg_base_write(out.file, "Base", 2, 3, &out.base);
  cg_zone_write(out.file, out.base, "Zone", size.data(), Unstructured, &out.zone);
  std::vector<double> x, z(2 * row);
  std::vector<float> y;
  for (cgsize_t i = 0; i < 2 * row; ++i) {
    x.push_back(i % row + 0.1);
    y.push_back(i < row ? 0.F : 1.1F);
  }
  cg_coord_write(out.file, out.base, out.zone, RealDouble, "CoordinateX", x.data(), &out.at);
  cg_coord_write(out.file, out.base, out.zone, RealSingle, "CoordinateY", y.data(), &out.at);
  cg_coord_write(out.file, out.base, out.zone, RealDouble, "CoordinateZ", z.data(), &out.at);
  out.section("Last", QUAD_4, 14, 20, squares(5, 12));
  out.section("Halves", TRI_3, 1, 6, halves(0, 3));
  out.section("First", QUAD_4, 7, 7, squares(3, 4));
  out.section("MoreHalves", TRI_3, 8, 9, halves(4, 5));
  out.section("wall", BAR_2, 10, 11, {1, 2, 2, 3});
  out.section("inside", BAR_2, 12, 13, {row + 6, 6, 7, row + 7});
  out.section("left", BAR_2, 21, 21, {row + 1, 1});
  cg_boco_write(out.file, out.base, out.zone, "wall", BCWall, ElementRange, 2,
                std::array<cgsize_t, 2>{10, 11}.data(), &out.at);
  const std::array<cgsize_t, 2> side{1, row + 1};
  cg_conn_write(out.file, out.base, out.zone, "Side", Vertex, Abutting1to1, PointList, 2, side.data(), "Zone",
                Unstructured, PointListDonor, LongInteger, 0, nullptr, &out.at);
  const std::array<float, 3> none{}, shift{2, 0, 0};
  cg_conn_periodic_write(out.file, out.base, out.zone, out.at, none.data(), none.data(), shift.data());
  int nodal = 0, in_cells = 0;
  cg_sol_write(out.file, out.base, out.zone, "Flow", Vertex, &nodal);
  std::vector<double> values(2 * row);
  std::iota(values.begin(), values.end(), 0.25);
  out.field(nodal, "Density", RealDouble, values);
  out.field(nodal, "Mach", RealSingle, std::vector<float>(values.begin(), values.end()));
  cg_sol_write(out.file, out.base, out.zone, "Cells", CellCenter, &in_cells);
  std::vector<int> numbers(columns + 4);
  std::iota(numbers.begin(), numbers.end(), 100);
  out.field(in_cells, "Number", Integer, numbers);
  ASSERT_EQ(cg_close(out.file), CG_OK);
}

/// Stores a dataset in another way, with the same or other numbers.
template <class Change>
void change_data(const std::string& path, const std::string& node, hid_t type, hid_t layout,
                 const Change& change) {
  const std::string name = node + "/ data";
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              old = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(old);
  ASSERT_GE(old, 0) << name;
  std::vector<double> numbers(H5Sget_simple_extent_npoints(space));
  H5Dread(old, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  const hid_t stored = type == 0 ? H5Dget_type(old) : H5Tcopy(type);
  H5Dclose(old);
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  change(numbers);
  const hid_t data = H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, layout, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
  H5Dclose(data);
  H5Tclose(stored);
  H5Sclose(space);
  H5Fclose(file);
}

void keep(std::vector<double>& /*numbers*/) {}

/// A compressed dataset is not one piece of the file.
void compress(const std::string& path, const std::string& node) {
  const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk = 5;
  H5Pset_chunk(packed, 1, &chunk);
  H5Pset_deflate(packed, 6);
  change_data(path, node, 0, packed, keep);
  H5Pclose(packed);
}

/// The file after a change that the root makes.
std::string changed_file(const TemporaryFolder& folder, const std::string& name,
                         const std::function<void(const std::string&)>& change) {
  const std::string path = folder.file(name);
  if (world().is_root()) {
    write_row(path);
    change(path);
  }
  world().barrier();
  return path;
}

bool is_by_ranges(const std::string& path) {
  const auto contents = read_separately<CgnsContents>("cgns", path);
  EXPECT_EQ(contents.mesh.points.empty(), contents.by_ranges);
  return contents.by_ranges;
}

/// Reads with all ranks; compares with what one rank reads of the same file in the usual form.
void expect_row(const std::string& path, const std::string& usual) {
  const LoadedMesh whole = gathered(world(), std::get<LoadedMesh>(read_cgns(world(), path)));
  if (!world().is_root()) return;
  LoadedMesh wanted = test::read_plane<read_cgns>(usual);
  for (std::string& warning : wanted.warnings) warning.replace(0, usual.size(), path);
  expect_same(whole, wanted);
}

TEST(CgnsRanges, GiveTheMeshThatIsReadAsAWhole) {
  const TemporaryFolder folder;
  const std::string ranges = changed_file(folder, "ranges.cgns", [](const std::string&) {}),
                    whole = changed_file(folder, "whole.cgns", [](const std::string&path) {
                      compress(path, "/Base/Zone/GridCoordinates/CoordinateX");
                    });
  EXPECT_TRUE(is_by_ranges(ranges));
  EXPECT_FALSE(is_by_ranges(whole));
  expect_row(ranges, whole);
  expect_row(whole, ranges);
  const LoadedMesh part = std::get<LoadedMesh>(read_cgns(world(), ranges));
  EXPECT_EQ(part.mesh.owned_nodes,
            2 * row * (world().rank() + 1) / world().size() - 2 * row * world().rank() / world().size());
  ASSERT_EQ(part.inner_curves.size(), 1U);
  EXPECT_EQ(part.inner_curves[0].name, "inside");
  EXPECT_EQ(world().sum(std::ssize(part.inner_curves[0].edges)), 2);
  ASSERT_EQ(part.mesh.boundaries.size(), 2U);
  EXPECT_EQ(part.mesh.boundaries[0].condition, BoundaryCondition::wall);
}

TEST(CgnsRanges, TakeValuesInCellsByElement) {
  const TemporaryFolder folder;
  const std::string path = changed_file(folder, "m.cgns", [](const std::string&) {});
  const LoadedMesh whole = gathered(world(), std::get<LoadedMesh>(read_cgns(world(), path)));
  if (!world().is_root()) return;
  ASSERT_TRUE(whole.solution);
  EXPECT_EQ(whole.solution->cells.values, (std::vector<double>{100, 101, 102, 103, 104, 105, 107, 108, 109,
                                                               110, 111, 112, 113, 114, 115, 106}));
  EXPECT_EQ(whole.solution->values.at(2 * 14 + 1), 14.25);
}

TEST(CgnsRanges, ReadNumbersOfAnySizeAndOrder) {
  const TemporaryFolder folder;
  const std::string usual = changed_file(folder, "usual.cgns", [](const std::string&) {}),
                    other = changed_file(folder, "other.cgns", [](const std::string&path) {
                      change_data(path, "/Base/Zone/GridCoordinates/CoordinateX", H5T_IEEE_F64BE, H5P_DEFAULT,
                                  keep);
                      change_data(path, "/Base/Zone/Last/ElementConnectivity", H5T_STD_I64LE, H5P_DEFAULT,
                                  keep);
                      change_data(path, "/Base/Zone/Halves/ElementConnectivity", H5T_STD_I32BE, H5P_DEFAULT,
                                  keep);
                      change_data(path, "/Base/Zone/Cells/Number", H5T_STD_I64BE, H5P_DEFAULT, keep);
                      change_data(path, "/Base/Zone/Flow/Density", H5T_IEEE_F32BE, H5P_DEFAULT, keep);
                    });
  EXPECT_TRUE(is_by_ranges(other));
  expect_row(other, usual);
}

TEST(CgnsRanges, NameTheFirstErrorOnAllRanks) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto refusal = [](const std::string& node, std::size_t at, double number) {
    const TemporaryFolder folder;
    const std::string path = changed_file(folder, "m.cgns", [&](const std::string& file) {
      change_data(file, node, 0, H5P_DEFAULT, [&](std::vector<double>& numbers) { numbers.at(at) = number; });
    });
    const std::string text = test::refusal_text([&] { read_cgns(world(), path); });
    return text.substr(text.find("m.cgns"));
  };
  EXPECT_EQ(refusal("/Base/Zone/Last/ElementConnectivity", 27, 99),
            "m.cgns: zone Zone: an element names node 99, which is none of 1 to 26");
  EXPECT_EQ(refusal("/Base/Zone/Halves/ElementConnectivity", 0, 0),
            "m.cgns: zone Zone: an element names node 0, which is none of 1 to 26");
  EXPECT_EQ(refusal("/Base/Zone/GridCoordinates/CoordinateY", 25, infinite),
            "m.cgns: zone Zone: node 26 has a coordinate that is not finite");
  EXPECT_EQ(refusal("/Base/Zone/GridCoordinates/CoordinateZ", 13, 1e-9),
            "m.cgns: zone Zone: its nodes do not lie in the plane z = 0");
}

/// The sides of a pair, which the mesh has, are not also listed as other periodic sides.
TEST(CgnsRanges, ListNoNodesOfPairsAsPeriodic) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const std::string text =
      "8\n0 0\n1 0\n2 0\n3 0\n0 1\n1 1\n2 1\n3 1\n1\n0\n3\n1 2 6 5\n2 3 7 6\n3 4 8 7\n3\n#edges (left)\n1\n5 "
      "1\n"
      "#edges (right)\n1\n4 8\n#edges (others)\n6\n1 2\n2 3\n3 4\n8 7\n7 6\n6 5\n"
      "# pair left right translation 3 0\n";
  const std::string path = folder.file("m.cgns");
  const LoadedMesh mesh = read_native(alone, folder.write("m.mesh", text));
  if (world().is_root()) write_mesh_file(alone, mesh, path);
  world().barrier();
  EXPECT_EQ(world().sum(std::ssize(std::get<LoadedMesh>(read_cgns(world(), path)).periodic_nodes)), 4);
  const LoadedMesh part = read_mesh(world(), path);
  EXPECT_EQ(part.mesh.pairs.size(), 1U);
  EXPECT_TRUE(part.periodic_nodes.empty());
}

TEST(CgnsRanges, AreOfFilesWith64BitSizesToo) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const LoadedMesh mesh = read_native(
      alone, folder.write("m.mesh", "4\n0 0\n1 0\n1 1\n0 1\n1\n1\n1 2 3\n0\n1\n4\n1 2\n2 3\n3 4\n4 1\n"));
  for (const CgnsSizes sizes : {CgnsSizes::as_needed, CgnsSizes::always_64_bits}) {
    const std::string path = folder.file(sizes == CgnsSizes::as_needed ? "4.cgns" : "8.cgns");
    if (world().is_root()) {
      OutputSet outputs(alone);
      write_cgns(outputs, MeshStream(alone, mesh), path, sizes);
      outputs.commit();
    }
    world().barrier();
    const auto contents = read_separately<CgnsContents>("cgns", path);
    EXPECT_TRUE(contents.by_ranges);
    ASSERT_EQ(contents.sections.size(), 1U);
    EXPECT_EQ(contents.sections[0].nodes.number,
              sizes == CgnsSizes::as_needed ? CgnsArray::Number::integer_32 : CgnsArray::Number::integer_64);
    const LoadedMesh whole = gathered(world(), std::get<LoadedMesh>(read_cgns(world(), path)));
    EXPECT_TRUE(!world().is_root() || whole.mesh.triangles == mesh.mesh.triangles);
  }
}

TEST(CgnsRanges, RefuseATruncatedFileOnAllRanks) {
  const TemporaryFolder folder;
  const std::string path = changed_file(folder, "m.cgns", [](const std::string& file) {
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 2000);
  });
  const std::string text = test::refusal_text([&] { read_cgns(world(), path); });
  EXPECT_NE(text.find("m.cgns: "), std::string::npos) << text;
}

}  // namespace
}  // namespace quadloop::io
