// Which meshes are constrained Delaunay. On one rank alone.
#include "mesher/mesh/check/delaunay_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesher/geometry/predicates.hpp"

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

/// However flat the quadrilateral, and whichever nodes its triangles begin with.
TEST(DelaunayCheck, AgreesWithTheCircleOfEitherTriangle) {
  std::mt19937_64 random(11);
  const auto number = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int delaunay = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<Point, 4> p{{{0, 0}, {1, -number()}, {1 + number(), number()}, {0.5 - number(), 1}}};
    Mesh mesh = two_triangles(p, true);
    if (orientation(p[0], p[1], p[2]) <= 0 || orientation(p[0], p[2], p[3]) <= 0) continue;
    for (auto& triangle : mesh.triangles)
      std::rotate(triangle.begin(), triangle.begin() + static_cast<int>(random() % 3), triangle.end());
    const bool expected = in_circle(p[0], p[1], p[2], p[3]) <= 0;
    ASSERT_EQ(is_delaunay(mesh), expected) << i;
    delaunay += expected ? 1 : 0;
  }
  EXPECT_GT(delaunay, 100);
  EXPECT_LT(delaunay, 2900);
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
