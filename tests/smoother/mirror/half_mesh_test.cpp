// The half of a mesh that is its own mirror image, and the way back.
#include "smoother/mirror/half_mesh.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/mirrored_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

Mesh part_of(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

TEST(HalfMesh, IsAValidMeshWithABoundaryAlongTheAxis) {
  const test::Grid grid{6, {2, 1}};
  const Mesh above = grid.mesh();
  const Mesh part = part_of(test::with_image(above, MirrorAxis::x));
  HalfMesh half(world(), part, MirrorAxis::x, "axis", false);
  const Mesh whole = gather_whole(world(), half.mesh());
  if (!world().is_root()) return;
  EXPECT_EQ(whole.points.size(), above.points.size());
  EXPECT_EQ(whole.triangles.size(), above.triangles.size());
  EXPECT_EQ(whole.quads.size(), above.quads.size());
  EXPECT_TRUE(validate(whole).empty());
  EXPECT_EQ(whole.boundaries.back().name, "axis");
  EXPECT_EQ(whole.boundaries.back().edges.size(), 6);
}

TEST(HalfMesh, WhatBecameOfItIsReflected) {
  const Mesh above = test::Grid{6, {2, 1}}.mesh();
  Mesh part = part_of(test::with_image(above, MirrorAxis::x));
  HalfMesh half(world(), part, MirrorAxis::x, "axis", true);
  for (Point& p : half.mesh().points) p = {2 * p.x, 3 * p.y};
  const std::vector<Point> before = part.points;
  const std::vector<std::int32_t> standing = half.reflect({}, part);
  EXPECT_EQ(standing, std::vector<std::int32_t>(part.triangles.size(), 1));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(part.points[i], (Point{2 * before[i].x, 3 * before[i].y}));
  EXPECT_NO_THROW(require_mirror_images(world(), part, MirrorAxis::x));
}

/// A cell from one side to the other is its own image: it stays, and so do its nodes.
TEST(HalfMesh, CellsAcrossTheAxisStay) {
  Mesh mesh;
  mesh.points = {{0, -1}, {1, -1}, {1, 1}, {0, 1}, {1, 2}, {0, 2}, {0, -2}, {1, -2}};
  mesh.owned_nodes = size32(mesh.points);
  const auto n = [](int i) { return NodeId{i}; };
  mesh.quads = {{n(0), n(1), n(2), n(3)}, {n(3), n(2), n(4), n(5)}, {n(6), n(7), n(1), n(0)}};
  Mesh part = part_of(mesh);
  HalfMesh half(world(), part, MirrorAxis::x, "axis", false);
  EXPECT_EQ(world().sum(std::ssize(half.mesh().quads)), 1);
  const NodeFlags pinned = half.pinned({});
  for (const NodeId node : pinned.ids()) EXPECT_EQ(pinned[node] != 0, half.mesh().point(node).y == 1);
}

TEST(HalfMesh, TakesValuesOfItsCells) {
  const Mesh whole = test::with_image(test::Grid{4, {2, 1}}.mesh(), MirrorAxis::x);
  const Mesh part = part_of(whole);
  HalfMesh half(world(), part, MirrorAxis::x, "axis", false);
  std::vector<double> heights;
  const auto add = [&](const auto& cells) {
    for (const auto& cell : cells) heights.push_back(part.point(cell[0]).y);
  };
  add(part.triangles);
  add(part.quads);
  const std::vector<double> taken = half.of_cells(heights);
  ASSERT_EQ(taken.size(), half.mesh().triangles.size() + half.mesh().quads.size());
  std::size_t next = 0;
  for (const auto& cell : half.mesh().triangles) EXPECT_EQ(taken[next++], half.mesh().point(cell[0]).y);
  for (const auto& cell : half.mesh().quads) EXPECT_EQ(taken[next++], half.mesh().point(cell[0]).y);
  EXPECT_TRUE(half.of_cells(std::vector<double>{}).empty());
}

}  // namespace
}  // namespace quadloop::smoother
