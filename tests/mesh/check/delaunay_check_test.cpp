// Which meshes are constrained Delaunay. On one rank alone.
#include "mesher/mesh/check/delaunay_check.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

/// Four nodes with the diagonal from the first to the third, or the other one.
Mesh two_triangles(const std::array<Point, 4>& points, bool first_to_third) {
  Mesh mesh;
  for (const Point p : points) mesh.points.push_back(p);
  mesh.owned_nodes = 4;
  const std::array n{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}};
  if (first_to_third)
    mesh.triangles = {{n[0], n[1], n[2]}, {n[0], n[2], n[3]}};
  else
    mesh.triangles = {{n[0], n[1], n[3]}, {n[1], n[2], n[3]}};
  return mesh;
}

constexpr std::array<Point, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
    kite{{{0, 0}, {1, 0}, {1.5, 1.5}, {0, 1}}};

TEST(DelaunayCheck, TakesTheDiagonalThatTheCircleAllows) {
  EXPECT_FALSE(is_delaunay(two_triangles(kite, true)));
  EXPECT_TRUE(is_delaunay(two_triangles(kite, false)));
}

TEST(DelaunayCheck, NodesOnOneCircleAreNoContradiction) {
  EXPECT_TRUE(is_delaunay(two_triangles(square, true)));
  EXPECT_TRUE(is_delaunay(two_triangles(square, false)));
}

TEST(DelaunayCheck, AnEdgeBetweenBlocksIsAConstraint) {
  const Mesh mesh = two_triangles(kite, true);
  EXPECT_TRUE(is_delaunay(mesh, std::vector<std::int32_t>{0, 1}));
  EXPECT_FALSE(is_delaunay(mesh, std::vector<std::int32_t>{1, 1}));
}

TEST(DelaunayCheck, QuadsAndInvertedOrNoTrianglesAreNot) {
  Mesh mesh = two_triangles(square, true);
  EXPECT_FALSE(is_delaunay({}));
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_FALSE(is_delaunay(mesh));
  mesh = two_triangles(square, true);
  mesh.quads.push_back({NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}});
  EXPECT_FALSE(is_delaunay(mesh));
}

}  // namespace
}  // namespace quadloop
