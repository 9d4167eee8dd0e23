// Whether two meshes have the same nodes and cells.
#include "mesher/mesh/check/compare_meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mesh/mixed_square.hpp"

namespace quadloop {
namespace {

TEST(CompareMeshes, NodesMayLieOffByAMillionthOfTheShortestEdge) {
  const Mesh mesh = test::mixed_square();
  std::vector<Point> points = mesh.points;
  points[4].x += 0.9e-6;
  points[8].y -= 1.1e-6;
  EXPECT_EQ(nodes_elsewhere(points, mesh), NodeFlags({0, 0, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(CompareMeshes, CellsAreTheSameInAnyOrderAndFromAnyNode) {
  const Mesh mesh = test::mixed_square();
  Mesh other = mesh;
  std::ranges::reverse(other.triangles);
  for (auto& nodes : other.quads) std::ranges::rotate(nodes, nodes.begin() + 1);
  EXPECT_EQ(difference(other, mesh), "");
  EXPECT_FALSE(other_cell(other.triangles, mesh.triangles));
  other.quads.pop_back();
  EXPECT_NE(difference(other, mesh), "");
}

TEST(CompareMeshes, AnotherCellIsNamedByItsNodes) {
  const Mesh mesh = test::mixed_square();
  Mesh flipped = mesh;  // the other diagonal of the quarter to the north east
  flipped.triangles[2] = {NodeId{7}, NodeId{4}, NodeId{5}};
  flipped.triangles[3] = {NodeId{5}, NodeId{8}, NodeId{7}};
  EXPECT_NE(difference(flipped, mesh), "");
  EXPECT_EQ(other_cell(flipped.triangles, mesh.triangles), (std::array{NodeId{4}, NodeId{5}, NodeId{7}}));
}

}  // namespace
}  // namespace quadloop
