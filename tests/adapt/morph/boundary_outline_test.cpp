#include "adapt/morph/boundary_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

TEST(BoundaryOutline, IsWholeOnEveryRank) {
  const test::Grid grid{4};
  const Mesh whole = grid.mesh();
  const Mesh mesh = scatter_mesh(test::world(), whole, test::shuffled_order(whole, 1));
  const BoundaryOutline outline = outline_of(test::world(), mesh);
  ASSERT_EQ(outline.geometry.size(), 16);
  ASSERT_EQ(outline.geometry.loop_count(), 1);
  double twice_area = 0;
  for (std::int32_t v = 0; v < 16; ++v) {
    const Point p = outline.geometry.point(v), q = outline.geometry.point(outline.geometry.next(v));
    twice_area += cross(p, q);
    const bool is_wall = (p.y == 0 && q.y == 0) || (p.x == 1 && q.x == 1);
    EXPECT_EQ(outline.geometry.boundary(outline.geometry.boundary_of(v)).name, is_wall ? "wall" : "far");
  }
  EXPECT_EQ(twice_area, 2);
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
    for (std::int32_t v = 0; v < 16; ++v) {
      if (outline.nodes[v] != mesh.global(node)) continue;
      EXPECT_EQ(outline.geometry.point(v), mesh.point(node));
    }
  }
}

/// A grid of squares without two that touch in a corner: two bodies of one name, or a body and a cavity.
Mesh with_two_holes(std::int32_t n) {
  Mesh mesh = test::Grid{n}.mesh();
  const double h = 1.0 / n;
  BoundaryEdges hole{"body", "none", {}};
  const auto is_hole = [&](const auto& quad) {
    const Point low = mesh.point(quad[0]);
    return low == Point{h, h} || low == Point{2 * h, 2 * h};
  };
  const auto node_at = [&](Point p) {
    return NodeId{static_cast<std::int32_t>(std::ranges::find(mesh.points, p) - mesh.points.begin())};
  };
  for (const Point low : {Point{h, h}, Point{2 * h, 2 * h}}) {
    const std::array corners{node_at(low), node_at(low + Point{0, h}), node_at(low + Point{h, h}),
                             node_at(low + Point{h, 0})};
    for (std::size_t k = 0; k < 4; ++k) hole.edges.push_back({corners[k], corners[(k + 1) % 4]});
  }
  std::erase_if(mesh.triangles, [&](const auto& nodes) {
    double x = 0, y = 0;
    for (const NodeId node : nodes) {
      x += mesh.point(node).x / 3;
      y += mesh.point(node).y / 3;
    }
    return (h < x && x < 2 * h && h < y && y < 2 * h) || (2 * h < x && x < 3 * h && 2 * h < y && y < 3 * h);
  });
  std::erase_if(mesh.quads, is_hole);
  mesh.boundaries.push_back(hole);
  return mesh;
}

TEST(BoundaryOutline, TwoBodiesThatTouchAreTwoLoops) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh whole = with_two_holes(4);
    const Mesh mesh = scatter_mesh(test::world(), whole, test::shuffled_order(whole, seed));
    const BoundaryOutline outline = outline_of(test::world(), mesh);
    ASSERT_EQ(outline.geometry.loop_count(), 3) << seed;
    for (std::int32_t loop = 0; loop < 3; ++loop) {
      const std::int32_t size = outline.geometry.loop_start(loop + 1) - outline.geometry.loop_start(loop);
      EXPECT_TRUE(size == 16 || size == 4) << size;
    }
  }
}

TEST(BoundaryOutline, KnowsClosedBoundaries) {
  const auto is_closed = [](const Mesh& whole) {
    const Mesh mesh = scatter_mesh(test::world(), whole, test::shuffled_order(whole, 3));
    return has_closed_boundaries(test::world(), mesh);
  };
  const Mesh grid = test::Grid{4}.mesh();
  EXPECT_TRUE(is_closed(grid));
  EXPECT_TRUE(is_closed(with_two_holes(4))) << "two bodies that touch";
  Mesh with_line = grid;
  with_line.boundaries.push_back(
      {"line", BoundaryCondition::none, {{NodeId{6}, NodeId{7}}}, {}, false, true});
  EXPECT_FALSE(is_closed(with_line));
  Mesh open = grid;
  open.boundaries.front().edges.pop_back();
  EXPECT_FALSE(is_closed(open));
  Mesh with_crack = grid;
  with_crack.points[1] = with_crack.points[3];
  EXPECT_FALSE(is_closed(with_crack)) << "two nodes at one place";
}

}  // namespace
}  // namespace quadloop::adapt
