#include "adapt/morph/boundary_outline.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
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

}  // namespace
}  // namespace quadloop
