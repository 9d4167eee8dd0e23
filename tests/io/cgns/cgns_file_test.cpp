// CGNS files that others write, whole and wrong, put together by the library and, where that refuses to write
// what is wrong, by HDF5. On one rank alone.
#include "io/cgns/cgns_file.hpp"

#include <cgnslib.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <mpi.h>

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();

/// Puts other data, of a type and size that the file did not have, in the place of a dataset's; what is only
/// declared is nowhere in the file.
void replace_data(const std::string& path, const std::string& dataset, const std::vector<hsize_t>& size,
                  const std::vector<std::int32_t>& numbers) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  ASSERT_GE(H5Ldelete(file, dataset.c_str(), H5P_DEFAULT), 0) << dataset;
  const hid_t data =
      H5Dcreate2(file, dataset.c_str(), H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const bool written =
      numbers.empty() || H5Dwrite(data, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0;
  EXPECT_TRUE(written) << dataset;
  H5Dclose(data);
  H5Sclose(space);
  H5Fclose(file);
}

/// A unit square of one quad and, to its right, two triangles; the edges below are bars 4 and 5, the boundary
/// "wall".
void write_sample(const std::string& path, bool mixed) {
  int file = 0, base = 0, zone = 0, at = 0;
  const std::array<cgsize_t, 3> size{6, 3, 0};
  const std::array<double, 6> x{0, 1, 2, 0, 1, 2}, y{0, 0, 0, 1, 1, 1};
  cg_set_file_type(CG_FILE_HDF5);
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_WRITE, &file), CG_OK);
  cg_base_write(file, "Base", 2, 2, &base);
  cg_zone_write(file, base, "Zone", size.data(), Unstructured, &zone);
  cg_coord_write(file, base, zone, RealDouble, "CoordinateX", x.data(), &at);
  cg_coord_write(file, base, zone, RealDouble, "CoordinateY", y.data(), &at);
  if (mixed) {
    const std::array<cgsize_t, 19> elements{QUAD_4, 1, 2, 5,     4, TRI_3, 2,     3, 6, TRI_3,
                                            2,      6, 5, BAR_2, 1, 2,     BAR_2, 2, 3};
    const std::array<cgsize_t, 6> offsets{0, 5, 9, 13, 16, 19};
    EXPECT_EQ(
        cg_poly_section_write(file, base, zone, "All", MIXED, 1, 5, 0, elements.data(), offsets.data(), &at),
        CG_OK);
  } else {
    const std::array<cgsize_t, 4> quad{1, 2, 5, 4}, bars{1, 2, 2, 3};
    const std::array<cgsize_t, 6> triangles{2, 3, 6, 2, 6, 5};
    cg_section_write(file, base, zone, "Quads", QUAD_4, 1, 1, 0, quad.data(), &at);
    cg_section_write(file, base, zone, "Triangles", TRI_3, 2, 3, 0, triangles.data(), &at);
    cg_section_write(file, base, zone, "Bars", BAR_2, 4, 5, 0, bars.data(), &at);
  }
  EXPECT_EQ(cg_boco_write(file, base, zone, "wall", BCWall, PointRange, 2,
                          std::array<cgsize_t, 2>{4, 5}.data(), &at),
            CG_OK);
  cg_boco_gridlocation_write(file, base, zone, at, EdgeCenter);
  ASSERT_EQ(cg_close(file), CG_OK);
}

/// The refusal of the sample after one change; "" where it is read.
std::string refusal_after(const std::function<void(const std::string&)>& change, bool mixed = false) {
  const TemporaryFolder folder;
  const std::string path = folder.file("m.cgns");
  write_sample(path, mixed);
  change(path);
  try {
    test::read_plane<read_cgns>(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The same, where the numbers of the boundary's range are others.
std::string refusal_of_range(const std::vector<std::int32_t>& numbers) {
  return refusal_after([&](const std::string& path) {
    replace_data(path, "/Base/Zone/ZoneBC/wall/PointRange/ data", {numbers.size(), 1}, numbers);
  });
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks\n" << part;
}

TEST(CgnsReader, ReadsSectionsOfOneKindAndMixedOnes) {
  for (const bool mixed : {false, true}) {
    const TemporaryFolder folder;
    write_sample(folder.file("m.cgns"), mixed);
    const LoadedMesh loaded = test::read_plane<read_cgns>(folder.file("m.cgns"));
    EXPECT_EQ(loaded.mesh.quads.size(), 1U);
    EXPECT_EQ(loaded.mesh.triangles.size(), 2U);
    ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
    EXPECT_EQ(loaded.mesh.boundaries[0].name, "wall");
    EXPECT_EQ(loaded.mesh.boundaries[0].condition, BoundaryCondition::wall);
    EXPECT_EQ(loaded.mesh.boundaries[0].edges,
              (std::vector<std::array<NodeId, 2>>{{NodeId{0}, NodeId{1}}, {NodeId{1}, NodeId{2}}}));
  }
}

/// A periodic connectivity of the zone with itself.
void add_connection(const std::string& path, PointSetType_t set, GridLocation_t location,
                    const std::vector<cgsize_t>& numbers) {
  int file = 0, at = 0;
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_MODIFY, &file), CG_OK);
  ASSERT_EQ(cg_conn_write(file, 1, 1, "Connection", location, Abutting1to1, set,
                          static_cast<cgsize_t>(numbers.size()), numbers.data(), "Zone", Unstructured,
                          PointListDonor, LongInteger, 0, nullptr, &at),
            CG_OK)
      << cg_get_error();
  const std::array<float, 3> none{}, shift{2, 0, 0};
  EXPECT_EQ(cg_conn_periodic_write(file, 1, 1, at, none.data(), none.data(), shift.data()), CG_OK);
  cg_close(file);
}

TEST(CgnsReader, MarksPeriodicNodes) {
  const auto periodic = [](PointSetType_t set, GridLocation_t location,
                           const std::vector<cgsize_t>& numbers) {
    const TemporaryFolder folder;
    write_sample(folder.file("m.cgns"), false);
    add_connection(folder.file("m.cgns"), set, location, numbers);
    return test::read_plane<read_cgns>(folder.file("m.cgns")).periodic_nodes;
  };
  EXPECT_EQ(periodic(PointList, Vertex, {1, 4}), (std::vector{NodeId{0}, NodeId{3}}));
  EXPECT_EQ(periodic(PointRange, Vertex, {1, 3}), (std::vector{NodeId{0}, NodeId{2}, NodeId{1}}));
  EXPECT_EQ(periodic(PointList, FaceCenter, {5}), (std::vector{NodeId{1}, NodeId{2}}));
  const TemporaryFolder folder;
  write_sample(folder.file("m.cgns"), false);
  EXPECT_TRUE(test::read_plane<read_cgns>(folder.file("m.cgns")).periodic_nodes.empty());
}

/// Two unit squares side by side, each a zone with a boundary all round; the second has its nodes in another
/// order.
void write_two_zones(const std::string& path, double gap = 0) {
  int file = 0, base = 0, at = 0;
  cg_set_file_type(CG_FILE_HDF5);
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_WRITE, &file), CG_OK);
  cg_base_write(file, "Base", 2, 2, &base);
  const std::array<cgsize_t, 3> size{4, 1, 0};
  const std::array<cgsize_t, 4> quad{1, 2, 3, 4};
  const std::array<cgsize_t, 8> bars{1, 2, 2, 3, 3, 4, 4, 1};
  for (const bool right : {false, true}) {
    int zone = 0;
    const std::array<double, 4> x =
        right ? std::array<double, 4>{2, 2, 1 + gap, 1 + gap} : std::array<double, 4>{0, 1, 1, 0};
    const std::array<double, 4> y =
        right ? std::array<double, 4>{0, 1, 1, 0} : std::array<double, 4>{0, 0, 1, 1};
    cg_zone_write(file, base, right ? "Right" : "Left", size.data(), Unstructured, &zone);
    cg_coord_write(file, base, zone, RealDouble, "CoordinateX", x.data(), &at);
    cg_coord_write(file, base, zone, RealDouble, "CoordinateY", y.data(), &at);
    cg_section_write(file, base, zone, "Quads", QUAD_4, 1, 1, 0, quad.data(), &at);
    cg_section_write(file, base, zone, right ? "right" : "left", BAR_2, 2, 5, 0, bars.data(), &at);
  }
  ASSERT_EQ(cg_close(file), CG_OK);
}

/// Connects nodes of the right zone with those of a donor.
void connect_right(const std::string& path, const char* donor, const std::vector<cgsize_t>& nodes,
                   const std::vector<cgsize_t>& of_donor) {
  int file = 0, at = 0;
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_MODIFY, &file), CG_OK);
  const auto count = static_cast<cgsize_t>(nodes.size());
  ASSERT_EQ(cg_conn_write(file, 1, 2, "Connection", Vertex, Abutting1to1, PointList, count, nodes.data(),
                          donor, Unstructured, PointListDonor, sizeof(cgsize_t) == 4 ? Integer : LongInteger,
                          count, of_donor.data(), &at),
            CG_OK)
      << cg_get_error();
  cg_close(file);
}

TEST(CgnsReader, ConnectedNodesAreOneWhereverTheyAre) {
  const TemporaryFolder folder;
  const std::string path = folder.file("m.cgns");
  write_two_zones(path, 1e-9);
  EXPECT_EQ(test::read_plane<read_cgns>(path).mesh.points.size(), 8U);
  connect_right(path, "Left", {4, 3}, {2, 3});
  const LoadedMesh loaded = test::read_plane<read_cgns>(path);
  EXPECT_EQ(loaded.mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}}));
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 3U);
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
}

TEST(CgnsReader, ZonesConnectedAtSomeNodesHaveTheOthersTwice) {
  const TemporaryFolder folder;
  const std::string path = folder.file("m.cgns");
  write_two_zones(path);
  connect_right(path, "Left", {4}, {2});
  EXPECT_EQ(test::read_plane<read_cgns>(path).mesh.points.size(), 7U);
}

TEST(CgnsReader, RefusesConnectionsOfNothing) {
  for (const auto& [donor, node, wanted] :
       {std::tuple{"Left", 5, "names node 5"}, {"Nowhere", 2, "zone Nowhere"}}) {
    const TemporaryFolder folder;
    const std::string path = folder.file("m.cgns");
    write_two_zones(path);
    connect_right(path, donor, {4}, {node});
    try {
      test::read_plane<read_cgns>(path);
      ADD_FAILURE() << wanted;
    } catch (const InputError& error) {
      expect_in(error.what(), wanted);
    }
  }
}

TEST(CgnsReader, NodesOfSeveralZonesAtOnePlaceAreOne) {
  const TemporaryFolder folder;
  write_two_zones(folder.file("m.cgns"));
  const LoadedMesh loaded = test::read_plane<read_cgns>(folder.file("m.cgns"));
  EXPECT_EQ(loaded.blocks, 2);
  EXPECT_EQ(loaded.mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}}));
  EXPECT_EQ(loaded.mesh.owned_nodes, 6);
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 4U);  // with the one between the zones
  EXPECT_EQ(loaded.mesh.boundaries[1].edges.size(), 3U);
  for (const MeshFault& fault : validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}))
    ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what;
}

TEST(CgnsFile, KeepsTheNamesOfVariables) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const Mesh mesh = test::sample_mesh(3);
  const std::string of_40(40, 'y');
  Field field{{"density", "Density", "a/b", of_40 + "1", of_40 + "2", "Rind", "VelocityX"}, {}, {}};
  for (std::size_t i = 0; i < 7 * mesh.points.size(); ++i) field.values.push_back(static_cast<double>(i));
  field.cells.names = {"GridLocation", "CoordinateX"};
  for (std::size_t i = 0; i < 2 * (mesh.triangles.size() + mesh.quads.size()); ++i)
    field.cells.values.push_back(1 / static_cast<double>(i + 1));
  test::write_alone(alone, mesh, folder.file("a.cgns"), &field);
  const LoadedMesh read = test::read_plane<read_cgns>(folder.file("a.cgns"));
  ASSERT_TRUE(read.solution);
  EXPECT_EQ(read.solution->names, field.names);
  EXPECT_EQ(read.solution->values, field.values);
  EXPECT_EQ(read.solution->cells.names, field.cells.names);
  EXPECT_EQ(read.solution->cells.values, field.cells.values);
}

TEST(CgnsReader, RefusesRangesThatAreNone) {
  expect_in(refusal_of_range({5, 1}),
            "m.cgns: zone Zone: boundary wall is of the elements 5 to 1, which is no range");
  expect_in(refusal_of_range({4, largest}), "boundary wall names element 6, which is no BAR_2");
  expect_in(refusal_of_range({1, largest}), "boundary wall names element 1, which is no BAR_2");
  expect_in(refusal_of_range({4}), "m.cgns: ");
  expect_in(refusal_of_range({-largest, largest}), "which is no BAR_2");
}

TEST(CgnsReader, RefusesSectionsThatDoNotHoldTheirRange) {
  const auto refusal = [](const std::vector<std::int32_t>& range) {
    return refusal_after([&](const std::string& path) {
      replace_data(path, "/Base/Zone/Bars/ElementRange/ data", {2}, range);
    });
  };
  for (const std::vector<std::int32_t>& range :
       {std::vector<std::int32_t>{5, 4}, {4, largest}, {4, 4}, {-3, largest}, {0, 1}}) {
    expect_in(refusal(range), "m.cgns: ");
  }
}

/// The library writes as many offsets as the file has, whatever the section's range: more than there is room
/// for.
TEST(CgnsReader, TakesNoOffsetsOfMixedSectionsThatItHasNoRoomFor) {
  const std::vector<std::int32_t> offsets(100000, 0);
  const std::string refusal = refusal_after(
      [&](const std::string& path) {
        replace_data(path, "/Base/Zone/All/ElementStartOffset/ data", {offsets.size()}, offsets);
      },
      true);
  EXPECT_EQ(refusal.find("crashed"), std::string::npos) << refusal;
}

TEST(CgnsReader, TakesNoMemoryForWhatIsOnlyDeclared) {
  expect_in(refusal_after([](const std::string& path) {
              replace_data(path, "/Base/Zone/ data", {3, 1}, {largest, 3, 0});
            }),
            "m.cgns: ");
  expect_in(refusal_after([](const std::string& path) {
              replace_data(path, "/Base/Zone/Quads/ElementConnectivity/ data", {1U << 30}, {});
            }),
            "m.cgns: ");
}

TEST(TreeReader, RefusesMoreRowsThanTheFileHolds) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.h5");
  write_tree(test::world(), test::sample_tree(100, 0, 1), path);
  for (const char* name : {"x", "y", "tree", "level", "wanted", "mark", "triangles", "quads", "adapted"}) {
    const bool pair = std::string(name) == "tree";
    replace_data(path, name, pair ? std::vector<hsize_t>{1U << 28, 2} : std::vector<hsize_t>{1U << 28}, {});
  }
  std::string refusal;
  try {
    read_tree(test::world(), path);
  } catch (const InputError& error) {
    refusal = error.what();
  }
  expect_in(refusal, "t.h5: its dataset \"tree\" is said to have 268435456 rows, more than the file holds");
}

}  // namespace
}  // namespace quadloop::io
