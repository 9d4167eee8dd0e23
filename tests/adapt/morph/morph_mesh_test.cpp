#include "adapt/morph/morph_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adapt/morph/mesh_motion.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// The outline of a mesh, each of its points somewhere else.
Geometry outline_moved(const Mesh& mesh, const std::function<Point(Point)>& to) {
  const BoundaryOutline outline = outline_of(world(), mesh);
  std::vector<Chain> chains = chains_of(outline.geometry);
  for (Chain& chain : chains) {
    for (Point& p : chain.points) p = to(p);
  }
  Warnings warnings;
  return assemble(chains, {}, warnings);
}

Mesh spread(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

TEST(MorphMesh, StaysOnItsOwnOutline) {
  Mesh mesh = spread(test::Grid{8}.mesh());
  const std::vector<Point> before = mesh.points;
  const Geometry same = outline_moved(mesh, [](Point p) { return p; });
  const MorphReport report = morph_mesh(world(), mesh, {same, "same.geom"});
  EXPECT_EQ(mesh.points, before);
  EXPECT_EQ(report.moved, 0);
}

TEST(MorphMesh, FollowsASideThatBends) {
  Mesh mesh = spread(test::Grid{16}.mesh());
  const std::vector<Point> before = mesh.points;
  const Geometry old = outline_moved(mesh, [](Point p) { return p; });
  const auto bent = [](Point p) { return p.y == 0 ? Point{p.x, 0.03 * std::sin(3 * p.x) * (1 - p.x)} : p; };
  const Geometry to = outline_moved(mesh, bent);
  const MorphReport report = morph_mesh(world(), mesh, {to, "bent.geom", &old});
  EXPECT_FALSE(report.smoothed);
  EXPECT_GT(report.worst_after, 0.6);
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
    const Point from = before[node.value()], now = mesh.point(node), wanted = bent(from);
    if (from.y == 0 || from.y == 1 || from.x == 0 || from.x == 1) {
      EXPECT_NEAR(now.x, wanted.x, 1e-14);
      EXPECT_NEAR(now.y, wanted.y, 1e-14);
    }
  }
}

TEST(MorphMesh, ColumnsOfLayersKeepTheirHeights) {
  test::LayeredStrip strip;
  strip.columns = 12;
  strip.from = 0;
  for (const bool triangles : {false, true}) {
    strip.triangles = triangles;
    const Mesh whole = strip.mesh();
    Mesh mesh = spread(whole);
    const Geometry old = outline_moved(mesh, [](Point p) { return p; });
    const auto bent = [](Point p) {
      return p.y < 5 ? Point{p.x, p.y + 0.3 * std::pow(std::sin(p.x / 12 * 3.14159265), 2)} : p;
    };
    const Geometry to = outline_moved(mesh, [&](Point p) { return p.y == 0 ? bent(p) : p; });
    const MorphReport report = morph_mesh(world(), mesh, {to, "bent.geom", &old});
    ASSERT_TRUE(report.valid());
    const MeshOrder order = test::shuffled_order(whole, 5);
    Mesh moved = whole;
    gather_mesh(world(), mesh, order, moved);
    if (!world().is_root()) continue;
    for (std::int32_t i = 1; i < strip.columns; ++i) {
      const Point foot = moved.point(strip.node(i, 0));
      for (std::int32_t j = 1; j <= strip.layers; ++j)
        EXPECT_NEAR(length(moved.point(strip.node(i, j)) - foot), strip.height(j), 1e-13) << i << ", " << j;
    }
  }
}

TEST(MorphMesh, NodesAreASmoothFunctionOfTheOutline) {
  const Mesh first = spread(test::Grid{12}.mesh());
  const auto places = [&](double step) {
    Mesh mesh = first;
    const Geometry old = outline_moved(mesh, [](Point p) { return p; });
    const Geometry to = outline_moved(mesh, [&](Point p) {
      return p.y == 0 ? Point{p.x, 0.1 * p.x * (1 - p.x) + step * std::sin(3.14159265 * p.x)} : p;
    });
    morph_mesh(world(), mesh, {to, "to.geom", &old});
    return mesh.points;
  };
  const double h = 1e-4;
  const std::vector<Point> back = places(-h), at = places(0), ahead = places(h), far = places(10 * h);
  for (std::int32_t i = 0; i < first.owned_nodes; ++i) {
    const double slope = (ahead[i].y - back[i].y) / (2 * h);
    EXPECT_LT(std::abs(ahead[i].y - 2 * at[i].y + back[i].y), 1e-8);
    EXPECT_NEAR((far[i].y - at[i].y) / (10 * h), slope, 3e-3);
  }
}

/// Pushes the lower side up, so that cells are smoothed, and expects the nodes on the middle column where the
/// field of the boundary moves them.
void expect_middle_not_smoothed(const Mesh& whole) {
  Mesh mesh = test::part_with_blocks(world(), whole, test::shuffled_order(whole, 5));
  const std::vector<Point> before = mesh.points;
  const Geometry old = outline_moved(mesh, [](Point p) { return p; });
  const Geometry to = outline_moved(mesh, [](Point p) {
    return p.y == 0 ? Point{p.x, 0.3 * std::sin(3.14159265 * p.x)} : p;
  });
  const OutlineChange change{to, "to.geom", &old};
  const MeshMotion motion(world(), mesh, change);
  const InverseDistance field = motion.field(
      motion.reach(), [&](std::int32_t foot) { return linear_motion(motion.boundary()[foot].motion); });
  const MorphReport report = morph_mesh(world(), mesh, change);
  ASSERT_TRUE(report.smoothed && report.valid()) << report.worst_before << ' ' << report.worst_after;
  bool moved = false;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
    if (motion.foot(node) >= 0) continue;
    const Point from = before[node.value()];
    const double away = length(mesh.point(node) - from - field.displacement(from));
    moved = moved || away > 1e-6;
    if (from.x == 0.5) {
      EXPECT_LT(away, 1e-14) << from.y;
    }
  }
  EXPECT_TRUE(world().any(moved)) << "by smoothing";
}

TEST(MorphMesh, SmoothsNeitherNodesBetweenBlocksNorThoseOfInnerLines) {
  const test::Grid grid{12};
  Mesh blocks = test::two_blocks(grid);
  blocks.boundaries.pop_back();  // the edges between the blocks have no name
  expect_middle_not_smoothed(blocks);
  Mesh with_line = test::Grid{12, {1, 1}, false}.mesh();
  BoundaryEdges line{"line", BoundaryCondition::none, {}, {}, false, true};
  for (std::int32_t row = 1; row < 11; ++row)
    line.edges.push_back({NodeId{13 * row + 6}, NodeId{13 * (row + 1) + 6}});
  with_line.boundaries.push_back(line);
  expect_middle_not_smoothed(with_line);
}

/// A quad in a corner of the outline has two sides there, which must not be turned in.
TEST(MorphMesh, TellsHowFarCellsCanFollow) {
  const test::LayeredStrip strip;
  const double top = strip.height(strip.rows()), right = strip.columns;
  Mesh mesh = spread(strip.mesh());
  const Geometry old = outline_moved(mesh, [](Point p) { return p; });
  const Geometry to = outline_moved(mesh, [&](Point p) {
    return p == Point{right, top} ? Point{right - 0.6, top - 0.6} : p;
  });
  const MorphReport report = morph_mesh(world(), mesh, {to, "far.geom", &old});
  EXPECT_FALSE(report.valid());
  EXPECT_TRUE(report.smoothed);
  EXPECT_NEAR(report.possible_way, 1 / 1.2, 1.0 / 128) << "then it lies between its neighbours";
}

}  // namespace
}  // namespace quadloop::adapt
