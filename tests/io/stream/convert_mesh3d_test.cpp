// 3D meshes that are held, from each format to each: points, cells in their order, patches, and the solution
// where both hold it. On one rank alone.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/check_mesh3d.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/topology.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

constexpr std::int32_t none = FileBoundary::no_node;

/// Two cubes, a prism on the right, a pyramid on the first's top and a tetrahedron beside it, with
/// coordinates that need all digits.
FileMesh sample() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0}, {0, 0, 1},     {1, 0, 1},
                 {1, 1, 1},  {0, 1, 1},  {2, 0, 0},  {2, 0, 1}, {0.5, 0.5, 2}, {2, 0.5, 2},
                 {-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, {-1, 1, 1}};
  for (Point3& p : mesh.points) p = {p.x / 3 + 1e-17, p.y / 7, p.z * std::sqrt(2.0)};
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}, {12, 0, 3, 13, 14, 4, 7, 15}};
  mesh.prisms = {{1, 8, 2, 5, 9, 6}};
  mesh.pyramids = {{4, 5, 6, 7, 10}};
  mesh.tetrahedra = {{5, 11, 6, 10}};
  mesh.boundaries = {{"floor", "wall", {{3, 2, 1, 0}, {13, 3, 0, 12}, {1, 2, 8, none}}},
                     {"top-left", "symmetry", {{14, 4, 7, 15}}},
                     {"rest", "none", {}}};
  mesh.boundaries[2].faces = {{0, 1, 5, 4},      {2, 3, 7, 6},     {12, 13, 15, 14}, {12, 0, 4, 14},
                              {3, 13, 15, 7},    {1, 8, 9, 5},     {8, 2, 6, 9},     {5, 9, 6, none},
                              {4, 5, 10, none},  {6, 7, 10, none}, {7, 4, 10, none}, {5, 11, 10, none},
                              {11, 6, 10, none}, {5, 6, 11, none}};
  mesh.solution.emplace();
  mesh.solution->names = {"density", "x_velocity"};
  for (int i = 0; i < std::ssize(mesh.points); ++i)
    mesh.solution->values.insert(mesh.solution->values.end(), {(i + 1) / 7.0, -1.0 / (i + 3)});
  mesh.solution->cells = {{"pressure", "level"}, {0.1, 1, 0.2, 2, 0.3, 3, 1 / 7.0, 4, 5e-9, 5}};
  return mesh;
}

FileMesh through_file(const FileMesh& mesh, const std::string& path) {
  test::write_alone(Communicator(MPI_COMM_SELF), mesh, path);
  std::optional<FileMesh> back = test::read_mesh3d(path);
  EXPECT_TRUE(back);
  EXPECT_TRUE(back->warnings.empty());
  return std::move(*back);
}

/// These tell the faces of cells, not with which node they begin.
bool keeps_first_nodes(const std::string& format) { return format != "polyMesh" && format != "fluent.msh"; }

void expect_same(const FileMesh& back, const FileMesh& mesh, bool to_the_node) {
  EXPECT_EQ(back.points, mesh.points);
  for_each_kind_of_cell([&]<std::size_t width>() {
    auto found = cells_of<width>(back), wanted = cells_of<width>(mesh);
    if (!to_the_node) {
      for (auto& cell : found) std::ranges::sort(cell);
      for (auto& cell : wanted) std::ranges::sort(cell);
    }
    EXPECT_EQ(found, wanted);
  });
  ASSERT_EQ(back.boundaries.size(), mesh.boundaries.size());
  for (std::size_t p = 0; p < mesh.boundaries.size(); ++p) {
    EXPECT_EQ(back.boundaries[p].name, mesh.boundaries[p].name);
    EXPECT_EQ(back.boundaries[p].faces.size(), mesh.boundaries[p].faces.size());
  }
  const Mesh3dStatistics statistics = check_mesh3d(back);
  EXPECT_TRUE(statistics.faults.empty()) << statistics.faults.front().what;
}

TEST(ConvertMesh3d, EveryPairOfFormatsKeepsTheMesh) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const FileMesh mesh = sample();
  for (const std::string& first : read_formats_for({Content::mesh3d})) {
    for (const std::string& second : read_formats_for({Content::mesh3d})) {
      SCOPED_TRACE(first + " to " + second);
      const FileMesh between = through_file(mesh, folder.file("a." + first));
      const FileMesh back = through_file(between, folder.file("b." + second));
      expect_same(back, mesh, keeps_first_nodes(first) && keeps_first_nodes(second));
      const FileFormat &from = *format_named(first), &to = *format_named(second);
      const bool transferred = from.holds(Content::solution) && to.holds(Content::solution);
      ASSERT_EQ(back.solution.has_value(), transferred);
      if (transferred) {
        EXPECT_EQ(back.solution->names, mesh.solution->names);
        EXPECT_EQ(back.solution->values, mesh.solution->values);
        EXPECT_EQ(back.solution->cells.names, mesh.solution->cells.names);
        EXPECT_EQ(back.solution->cells.values, mesh.solution->cells.values);
      }
      bool knows_conditions = false, loses_conditions = false;
      for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
        const BoundaryCondition carried_condition = between.boundaries[b].condition;
        EXPECT_EQ(carried_condition, test::condition_back(first, mesh.boundaries[b].condition));
        EXPECT_EQ(back.boundaries[b].condition, test::condition_back(second, carried_condition));
        knows_conditions = knows_conditions || carried_condition != BoundaryCondition::none;
        loses_conditions = loses_conditions || back.boundaries[b].condition != carried_condition;
      }
      const std::size_t losses = (from.holds(Content::solution) && !to.holds(Content::solution) ? 1U : 0U) +
                                 (knows_conditions && loses_conditions ? 1U : 0U) +
                                 (!knows_conditions && to.unknown_boundary != nullptr ? 1U : 0U);
      EXPECT_EQ(losses_in(between, folder.file("b." + second)).size(), losses);
    }
  }
}

/// The first triangle of a prism looks outwards in VTK's and SU2's files, inwards in those of Gmsh and CGNS.
TEST(ConvertMesh3d, PrismsHaveTheOrderOfEachFormat) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.prisms = {{0, 1, 2, 3, 4, 5}};
  mesh.boundaries = {
      {"all", "none", {{0, 2, 1, none}, {3, 4, 5, none}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}};
  for (const auto& [format, row] : {std::pair{"su2", "13 0 2 1 3 5 4"}, {"msh", "6 2 2 2 1 2 3 4 5 6"}}) {
    const std::string path = folder.file(std::string("a.") + format);
    EXPECT_EQ(through_file(mesh, path).prisms, mesh.prisms);
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_NE(text.str().find(row), std::string::npos) << text.str();
  }
}

TEST(ConvertMesh3d, CellsThatAreInsideOutAreTurned) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const std::string path = folder.file("a.su2");
  std::ofstream(path)
      << "NDIME= 3\nNELEM= 1\n13 0 1 2 3 4 5\nNPOIN= 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 1 1\n";
  const std::optional<FileMesh> mesh = test::read_mesh3d(path);
  ASSERT_EQ(mesh->warnings, std::vector<std::string>{path + ": 1 cell was inside out and reversed"});
  EXPECT_EQ(mesh->prisms, (std::vector<std::array<std::int32_t, 6>>{{0, 1, 2, 3, 4, 5}}));
}

/// All faces of a tetrahedron are of the group "skin", the first of "inlet" too; a point is in a third group.
TEST(ConvertMesh3d, OfSeveralGroupsOfGmshTheSmallestIsTaken) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const std::string head =
      "$EndMeshFormat\n$PhysicalNames\n3\n0 9 \"probe\"\n2 1 \"skin\"\n2 2 \"inlet\"\n$EndPhysicalNames\n";
  const std::string path = folder.file("a.msh");
  std::ofstream(path)
      << "$MeshFormat\n2.2 0 8\n"
      << head
      << "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n6\n"
         "1 2 2 1 1 1 3 2\n2 2 2 2 1 1 3 2\n3 2 2 1 2 1 2 4\n4 2 2 1 3 2 3 4\n5 2 2 1 4 3 1 4\n"
         "6 4 2 5 1 1 2 3 4\n$EndElements\n";
  std::optional<FileMesh> mesh = test::read_mesh3d(path);
  ASSERT_EQ(mesh->boundaries.size(), 2);
  EXPECT_EQ(mesh->boundaries[0].name, "skin");
  EXPECT_EQ(mesh->boundaries[0].faces.size(), 3);
  EXPECT_EQ(mesh->boundaries[1].name, "inlet");
  EXPECT_EQ(mesh->boundaries[1].faces.size(), 1);
  EXPECT_TRUE(check_mesh3d(*mesh).faults.empty());
  EXPECT_EQ(mesh->warnings, (std::vector<std::string>{
                                path + ": 1 element in the groups 'inlet' and 'skin', assigned to 'inlet'",
                                path + ": physical groups of points and curves are left out: 'probe'"}));
}

TEST(ConvertMesh3d, Su2ZonesAreBlocks) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const std::string tetrahedron = "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n";
  const std::string marker =
      "NMARK= 1\nMARKER_TAG= all\nMARKER_ELEMS= 4\n5 0 2 1\n5 0 1 3\n5 1 2 3\n5 2 0 3\n";
  const std::string path = folder.file("a.su2");
  std::ofstream(path) << "NZONE= 2\nIZONE= 1\n"
                      << tetrahedron << "0 0 1\n"
                      << marker << "IZONE= 2\n"
                      << tetrahedron << "0 0 -2\n"
                      << marker;
  const std::optional<FileMesh> mesh = test::read_mesh3d(path);
  EXPECT_EQ(mesh->block_names, (std::vector<std::string>{"zone_1", "zone_2"}));
  EXPECT_EQ(blocks_of_cells(*mesh), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh->tetrahedra[1], (std::array{4, 6, 5, 7}));
  ASSERT_EQ(mesh->boundaries.size(), 1);
  EXPECT_EQ(mesh->boundaries[0].faces.size(), 8);
}

TEST(ConvertMesh3d, FacesHaveTheValuesOfTheCellBesideThem) {
  const Communicator alone(MPI_COMM_SELF);
  const FileMesh mesh = sample();
  const MeshStream stream(alone, mesh);
  const StreamCellValues cells(stream);
  EXPECT_EQ(cells.of_cell<CellKind::tetrahedron>(0, 1), 1);
  EXPECT_EQ(cells.of_cell<CellKind::prism>(0, 1), 3);
  EXPECT_EQ(cells.of_cell<CellKind::hexahedron>(1, 1), 5);
  EXPECT_EQ(cells.of_face<4>(0, 0, 1), 4);  // the floor of either cube
  EXPECT_EQ(cells.of_face<4>(0, 1, 1), 5);
  EXPECT_EQ(cells.of_face<3>(0, 0, 1), 3);  // and of the prism
  FileMesh stray = sample();
  stray.boundaries[1].faces.push_back({0, 2, 5, none});
  EXPECT_THROW(StreamCellValues(MeshStream(alone, stray)), OutputError);
}

TEST(ConvertMesh3d, FacesOfAnExtrudedMeshHaveThemToo) {
  const Communicator alone(MPI_COMM_SELF);
  const Mesh plane = test::sample_mesh(2);  // four triangles, two quads
  const Field field{{}, {}, {}, {{"p"}, {0, 1, 2, 3, 4, 5}}};
  const ExtrudedMesh mesh = extruded(plane, {0, 1, 3}, ExtrusionAxis::z, &field);
  const MeshStream stream(alone, mesh);
  const StreamCellValues cells(stream);
  const std::size_t back = stream.side_patches(), front = back + 1;
  for (std::int64_t row = 0; row < 4; ++row) EXPECT_EQ(cells.of_face<3>(back, row, 0), row);
  for (std::int64_t row = 0; row < 2; ++row) EXPECT_EQ(cells.of_face<4>(front, row, 0), 4 + row);
  std::vector<double> found, wanted;
  const std::optional<BoundaryStream> sides = cells.at_sides(0);
  ASSERT_TRUE(sides);
  for (std::size_t b = 0; b < sides->present().size(); ++b) {
    for (std::int64_t i = 0; i < sides->edges_of(b); ++i)
      found.insert(found.end(), cells.sides_on_edge(), StreamCellValues::value_of(sides->own_edge(b, i)));
  }
  const EdgeTable table(plane);
  for (const BoundaryEdges& boundary : plane.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      wanted.insert(wanted.end(), 2, table.cell_left_of(from, to));
  }
  EXPECT_EQ(found, wanted);
}

/// The cubes in one piece with the pyramid, which is in the other piece too, beside the rest.
TEST(ConvertMesh3d, PiecesArePutTogether) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  const FileMesh whole = sample();
  FileMesh first = whole, second = whole;
  first.prisms.clear();
  first.tetrahedra.clear();
  first.solution->cells.values = {0.2, 2, 1 / 7.0, 4, 5e-9, 5};
  second.hexahedra.clear();
  second.solution->cells.values = {0.1, 1, 9, 9, 0.3, 3};
  for (FileMesh* piece : {&first, &second}) piece->boundaries.clear();
  first.boundaries = {whole.boundaries[0], whole.boundaries[1]};
  first.boundaries[0].faces.pop_back();
  second.boundaries = {{"floor", "none", {whole.boundaries[0].faces[2]}}};
  test::write_alone(alone, first, folder.file("a.vtu"));
  test::write_alone(alone, second, folder.file("b.vtu"));
  const auto list = [](const std::string& sources) {
    return "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>" + sources +
           "</PUnstructuredGrid></VTKFile>\n";
  };
  const std::string a = "<Piece Source=\"a.vtu\"/>", b = "<Piece Source=\"b.vtu\"/>";
  test::write_bytes(folder.file("all.pvtu"), list(a + b));
  const std::optional<FileMesh> back = test::read_mesh3d(folder.file("all.pvtu"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->points, whole.points);
  for_each_kind_of_cell(
      [&]<std::size_t width>() { EXPECT_EQ(cells_of<width>(*back), cells_of<width>(whole)); });
  EXPECT_EQ(back->solution->values, whole.solution->values);
  EXPECT_EQ(back->solution->cells.values, whole.solution->cells.values);
  ASSERT_EQ(back->boundaries.size(), 2);
  EXPECT_EQ(back->boundaries[0].faces, whole.boundaries[0].faces);
  test::write_bytes(folder.file("one.pvtu"), list(b));
  EXPECT_EQ(test::read_mesh3d(folder.file("one.pvtu"))->pyramids, whole.pyramids);
  second.solution->cells.names = {"p", "level"};
  test::write_alone(alone, second, folder.file("b.vtu"));
  EXPECT_THROW(test::read_mesh3d(folder.file("all.pvtu")), InputError);
}

TEST(ConvertMesh3d, TheFormatIsThatOfTheSuffixUnlessItIsNamed) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  for (const char* name : {"su2", "lb8.ugrid", "msh"}) {
    test::write_alone(alone, sample(), folder.file(std::string("a.") + name));
    test::write_alone(alone, sample(), folder.file("b.x"), name);
    EXPECT_EQ(test::bytes_of(folder.file("b.x")), test::bytes_of(folder.file(std::string("a.") + name)));
  }
}

TEST(ConvertMesh3d, EmptyPatchesComeThroughAPolyMesh) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  FileMesh mesh = sample();
  mesh.boundaries[2].is_empty = true;
  const FileMesh back = through_file(mesh, folder.file("a.polyMesh"));
  EXPECT_FALSE(back.boundaries[0].is_empty);
  EXPECT_TRUE(back.boundaries[2].is_empty);
}

TEST(ConvertMesh3d, FormatsOfFacesNeedEachFaceOnce) {
  const test::TemporaryFolder folder;
  if (!test::world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  FileMesh open = sample(), twice = sample(), stray = sample();
  open.boundaries[1].faces.clear();
  twice.boundaries[1].faces.push_back(twice.boundaries[0].faces[0]);
  stray.boundaries[1].faces.push_back({0, 2, 5, none});
  for (const FileMesh* mesh : {&open, &twice, &stray}) {
    EXPECT_THROW(test::write_alone(alone, *mesh, folder.file("a.polyMesh")), OutputError);
    EXPECT_THROW(test::write_alone(alone, *mesh, folder.file("a.fluent.msh")), OutputError);
  }
}

}  // namespace
}  // namespace quadloop::io
