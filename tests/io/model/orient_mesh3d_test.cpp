// Cells that are inside out are turned by their neighbours; those that nodes have inverted stay.
#include "io/model/orient_mesh3d.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "io/model/check_mesh3d.hpp"

namespace quadloop::io {
namespace {

/// Two cubes, a prism on the right, a pyramid on the first's top and a tetrahedron beside it; no patches.
FileMesh five_cells() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0}, {0, 0, 1},     {1, 0, 1},
                 {1, 1, 1},  {0, 1, 1},  {2, 0, 0},  {2, 0, 1}, {0.5, 0.5, 2}, {2, 0.5, 2},
                 {-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, {-1, 1, 1}};
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}, {12, 0, 3, 13, 14, 4, 7, 15}};
  mesh.prisms = {{1, 8, 2, 5, 9, 6}};
  mesh.pyramids = {{4, 5, 6, 7, 10}};
  mesh.tetrahedra = {{5, 11, 6, 10}};
  return mesh;
}

std::int64_t flat_cells(const FileMesh& mesh) {
  std::int64_t count = 0;
  for (const Mesh3dFault& fault : check_mesh3d(mesh).faults)
    count += fault.rule == Mesh3dRule::positive ? 1 : 0;
  return count;
}

void expect_same_cells(const FileMesh& a, const FileMesh& b) {
  EXPECT_EQ(a.tetrahedra, b.tetrahedra);
  EXPECT_EQ(a.pyramids, b.pyramids);
  EXPECT_EQ(a.prisms, b.prisms);
  EXPECT_EQ(a.hexahedra, b.hexahedra);
}

TEST(OrientMesh3d, TurnsEachKindOfCell) {
  const FileMesh good = five_cells();
  FileMesh mesh = good;
  EXPECT_EQ(orient_mesh3d(mesh), 0);
  mesh.tetrahedra[0] = {5, 6, 11, 10};
  mesh.pyramids[0] = {4, 7, 6, 5, 10};
  mesh.prisms[0] = {1, 2, 8, 5, 6, 9};
  mesh.hexahedra[1] = {12, 13, 3, 0, 14, 15, 7, 4};
  EXPECT_EQ(flat_cells(mesh), 4);
  EXPECT_EQ(orient_mesh3d(mesh), 4);
  expect_same_cells(mesh, good);
  EXPECT_EQ(flat_cells(mesh), 0);
}

TEST(OrientMesh3d, LeavesCellsThatNodesHaveInverted) {
  FileMesh mesh = five_cells();
  mesh.points[8].x = mesh.points[9].x = 0;  // the prism alone turns over
  EXPECT_EQ(flat_cells(mesh), 1);
  const FileMesh tangled = mesh;
  EXPECT_EQ(orient_mesh3d(mesh), 0);
  expect_same_cells(mesh, tangled);
}

TEST(OrientMesh3d, TurnsAPieceThatIsAllInsideOut) {
  FileMesh mesh = five_cells();
  for (Point3& p : mesh.points) p.z = -p.z;
  EXPECT_EQ(orient_mesh3d(mesh), 5);
  EXPECT_EQ(flat_cells(mesh), 0);
}

}  // namespace
}  // namespace quadloop::io
