// Quadrilaterals that are no parallelograms become two triangles in their leaf's place; mirror images are
// divided alike.
#include "mesher/build/split_quads.hpp"

#include <gtest/gtest.h>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {
namespace {

using Triangles = std::vector<std::array<NodeId, 3>>;

TieRank rank_from_origin(Point p) { return tie_rank(Point{0, 0}, p); }

Mesh mesh_of(std::vector<Point> points, const std::vector<std::array<std::int32_t, 4>>& quads) {
  Mesh mesh;
  mesh.points = std::move(points);
  mesh.owned_nodes = size32(mesh.points);
  for (const auto& q : quads) mesh.quads.push_back({NodeId{q[0]}, NodeId{q[1]}, NodeId{q[2]}, NodeId{q[3]}});
  return mesh;
}

std::array<NodeId, 3> triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
  return {NodeId{a}, NodeId{b}, NodeId{c}};
}

LeafRecord leaf(std::int32_t triangles, std::int32_t quads) {
  LeafRecord record;
  record.triangles = triangles;
  record.quads = quads;
  return record;
}

TEST(SplitQuads, KeepsParallelograms) {
  Mesh mesh = mesh_of({{0, 0}, {2, 0}, {2.5, 1}, {0.5, 1.005}}, {{0, 1, 2, 3}});  // within a hundredth
  std::vector<LeafRecord> leaves{leaf(0, 1)};
  split_skew_quads(mesh, leaves, rank_from_origin);
  EXPECT_EQ(mesh.quads.size(), 1U);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(SplitQuads, PutsTrianglesIntoTheirLeafsPlace) {
  // a square and a triangle, then a kite, then a triangle
  Mesh mesh = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.6, 0.2}, {2, 1.2}}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  mesh.triangles = {triangle(0, 1, 3), triangle(4, 5, 2)};
  std::vector<LeafRecord> leaves{leaf(1, 1), leaf(0, 1), leaf(1, 0)};
  split_skew_quads(mesh, leaves, rank_from_origin);
  ASSERT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.triangles.front(), triangle(0, 1, 3));
  EXPECT_EQ(mesh.triangles.back(), triangle(4, 5, 2));
  EXPECT_EQ(mesh.quads.size(), 1U);
  const std::vector<std::pair<int, int>> expected{{1, 1}, {2, 0}, {1, 0}};
  for (std::size_t i = 0; i < leaves.size(); ++i)
    EXPECT_EQ(std::pair(leaves[i].triangles, leaves[i].quads), expected[i]) << i;
}

TEST(SplitQuads, TakesTheDelaunayDiagonal) {
  Mesh flat = mesh_of({{0, 0}, {2, -0.4}, {4, 0}, {2, 0.6}}, {{0, 1, 2, 3}}),
       upright = mesh_of({{0, -2}, {0.4, 0}, {0, 2}, {-0.6, 0}}, {{0, 1, 2, 3}});
  std::vector<LeafRecord> of_flat{leaf(0, 1)}, of_upright{leaf(0, 1)};
  split_skew_quads(flat, of_flat, rank_from_origin);
  split_skew_quads(upright, of_upright, rank_from_origin);
  EXPECT_EQ(flat.triangles, (Triangles{triangle(0, 1, 3), triangle(1, 2, 3)}));
  EXPECT_EQ(upright.triangles, (Triangles{triangle(0, 1, 3), triangle(1, 2, 3)}));
}

TEST(SplitQuads, DividesMirrorImagesAlike) {
  // A trapezoid's corners lie on one circle: only the ranks of its nodes choose.
  Mesh mesh = mesh_of({{1, 1}, {3, 1}, {2.5, 2}, {1.5, 2}}, {{0, 1, 2, 3}}),
       image = mesh_of({{-1, 1}, {-1.5, 2}, {-2.5, 2}, {-3, 1}}, {{0, 1, 2, 3}});
  std::vector<LeafRecord> of_mesh{leaf(0, 1)}, of_image{leaf(0, 1)};
  split_skew_quads(mesh, of_mesh, rank_from_origin);
  split_skew_quads(image, of_image, rank_from_origin);
  EXPECT_EQ(mesh.triangles,
            (Triangles{triangle(0, 1, 3),
                       triangle(1, 2, 3)}));  // the diagonal through (3, 1), farthest from the origin
  EXPECT_EQ(image.triangles, (Triangles{triangle(0, 1, 3), triangle(1, 2, 3)}));  // and through (-3, 1)
}

}  // namespace
}  // namespace quadloop
