// What is wrong with a 3D mesh: each rule broken once, and the figures of cells of every kind.
#include "io/model/check_mesh3d.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace quadloop::io {
namespace {

constexpr std::int32_t none = FileBoundary::no_node;

/// A cube, a prism on its right, a pyramid on its top and a tetrahedron beside that, all round them one patch
/// but for the floor, "floor".
FileMesh sample() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},     {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}, {0.5, 0.5, 2}, {2, 0.5, 2}};
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
  mesh.prisms = {{1, 8, 2, 5, 9, 6}};
  mesh.pyramids = {{4, 5, 6, 7, 10}};
  mesh.tetrahedra = {{5, 11, 6, 10}};
  mesh.boundaries = {{"floor", "wall", {{3, 2, 1, 0}, {1, 2, 8, none}}},
                     {"rest",
                      "none",
                      {{0, 1, 5, 4},
                       {2, 3, 7, 6},
                       {3, 0, 4, 7},
                       {1, 8, 9, 5},
                       {8, 2, 6, 9},
                       {5, 9, 6, none},
                       {4, 5, 10, none},
                       {6, 7, 10, none},
                       {7, 4, 10, none},
                       {5, 11, 10, none},
                       {11, 6, 10, none},
                       {5, 6, 11, none}}}};
  return mesh;
}

TEST(CheckMesh3d, MeasuresCellsOfEveryKind) {
  const Mesh3dStatistics statistics = check_mesh3d(sample());
  EXPECT_TRUE(statistics.faults.empty()) << statistics.faults.front().what;
  const double tetrahedron = 0.25;  // a sixth of the spat of its edges
  EXPECT_DOUBLE_EQ(statistics.volume, 1 + 0.5 + 1.0 / 3 + tetrahedron);
  EXPECT_DOUBLE_EQ(statistics.least_volume, tetrahedron);
  ASSERT_EQ(statistics.patches.size(), 2);
  EXPECT_EQ(statistics.patches[0].name, "floor");
  EXPECT_EQ(statistics.patches[0].faces, 2);
  EXPECT_DOUBLE_EQ(statistics.patches[0].area, 1.5);
}

TEST(CheckMesh3d, MeasuresBlocks) {
  EXPECT_TRUE(check_mesh3d(sample()).blocks.empty());
  FileMesh mesh = sample();
  mesh.block_names = {"rest", "cube"};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::tetrahedron)] = {0};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::pyramid)] = {0};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::prism)] = {0};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::hexahedron)] = {1};
  const Mesh3dStatistics statistics = check_mesh3d(mesh);
  ASSERT_EQ(statistics.blocks.size(), 2);
  EXPECT_EQ(statistics.blocks[0].cells, 3);
  EXPECT_DOUBLE_EQ(statistics.blocks[0].volume, 0.5 + 1.0 / 3 + 0.25);
  EXPECT_EQ(statistics.blocks[1].name, "cube");
  EXPECT_EQ(statistics.blocks[1].cells, 1);
  EXPECT_DOUBLE_EQ(statistics.blocks[1].volume, 1);
}

/// Among the faults once the sample has been changed.
void expect_fault(Mesh3dRule rule, const std::string& what, const std::function<void(FileMesh&)>& change) {
  FileMesh mesh = sample();
  change(mesh);
  const Mesh3dStatistics statistics = check_mesh3d(mesh);
  EXPECT_TRUE(std::ranges::any_of(statistics.faults, [&](const Mesh3dFault& fault) {
    return fault.rule == rule && fault.what.find(what) != std::string::npos;
  })) << what;
}

TEST(CheckMesh3d, NamesWhatIsBroken) {
  using enum Mesh3dRule;
  expect_fault(indices, "prism 1 names a node twice", [](FileMesh& mesh) { mesh.prisms[0][5] = 9; });
  expect_fault(indices, "hexahedron 1 names a node twice, or one that is none",
               [](FileMesh& mesh) { mesh.hexahedra[0][0] = 12; });
  expect_fault(indices, "node 3 has a coordinate", [](FileMesh& mesh) { mesh.points[2].z = 1.0 / 0.0; });
  expect_fault(positive, "prism 1 has no positive volume", [](FileMesh& mesh) {
    for (int k = 0; k < 3; ++k) std::swap(mesh.prisms[0][k], mesh.prisms[0][k + 3]);
  });
  expect_fault(conforming, "has no other cell and is on no patch",
               [](FileMesh& mesh) { mesh.boundaries[1].faces.pop_back(); });
  expect_fault(conforming, "is on patches 2 times, first on rest",
               [](FileMesh& mesh) { mesh.boundaries[0].faces.push_back(mesh.boundaries[1].faces.front()); });
  expect_fault(conforming, "a face inside, of hexahedron 1, is on floor", [](FileMesh& mesh) {
    mesh.boundaries[0].faces.push_back({1, 2, 6, 5});
  });
  expect_fault(conforming, "is that of no cell", [](FileMesh& mesh) {
    mesh.boundaries[0].faces.push_back({0, 1, 6, 7});
  });
  expect_fault(conforming, "belongs to 3 cells",
               [](FileMesh& mesh) { mesh.hexahedra.push_back(mesh.hexahedra.front()); });
}

TEST(CheckMesh3d, KeepsTheFirstFaultsAndCountsAll) {
  FileMesh mesh;
  for (int i = 0; i < 100; ++i) mesh.points.push_back({1.0 / 0.0, 0, 0});
  const Mesh3dStatistics statistics = check_mesh3d(mesh);
  EXPECT_EQ(statistics.all_faults, 101);  // there are no cells either
  EXPECT_LT(statistics.faults.size(), 30);
}

}  // namespace
}  // namespace quadloop::io
