// A part of a triangulation that changes node by node.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapt/metric/tile/operations.hpp"
#include "adapt/metric/tile/tile_mesh.hpp"
#include "adapt/metric/tile/tile_passes.hpp"
#include "adapt/metric/tile/walls.hpp"

namespace quadloop::adapt {
namespace {

/// A ring of triangles, n around and two deep, between a circle of radius 1, which is a hole, and one of 3.
struct Ring {
  static constexpr std::int32_t n = 16;

  static Point on(double radius, double step) {
    const double turn = 2 * std::numbers::pi * step / n;
    return {radius * std::cos(turn), radius * std::sin(turn)};
  }
  static Geometry outline() {
    std::vector<Point> points;
    constexpr std::int32_t fine = 16 * n;  // of which every sixteenth is a node
    for (std::int32_t i = 0; i < fine; ++i) points.push_back(on(3, i / 16.0));
    for (std::int32_t i = 0; i < fine; ++i) points.push_back(on(1, -i / 16.0));
    std::vector<BoundaryId> of_segments(fine, BoundaryId{0});
    of_segments.resize(2 * fine, BoundaryId{1});
    return {{{"outer"}, {"inner"}}, points, {0, fine, 2 * fine}, of_segments};
  }
  static std::vector<TileNode> nodes(double size) {
    std::vector<TileNode> all;
    for (const double radius : {1.0, 2.0, 3.0}) {
      for (std::int32_t i = 0; i < n; ++i)
        all.push_back({std::ssize(all), on(radius, i), log_of(isotropic(size))});
    }
    return all;
  }
  static std::vector<TileTriangle> triangles() {
    std::vector<TileTriangle> all;
    for (std::int32_t row = 0; row < 2; ++row) {
      for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = row * n + i, b = row * n + (i + 1) % n, c = a + n, d = b + n;
        all.push_back({{a, c, b}, {}});
        all.push_back({{b, c, d}, {}});
        if (row == 0) all[all.size() - 2].sides[2] = {1, false};
        if (row == 1) all.back().sides[1] = {0, false};
      }
    }
    return all;
  }

  explicit Ring(double size, std::vector<double> heights = {})
      : geometry{outline()},
        path{geometry},
        walls{path, {"outer", "inner"}, std::move(heights)},
        mesh{nodes(size), triangles(), walls} {}

  Geometry geometry;
  smoother::OutlinePath path;
  Walls walls;
  TileMesh mesh;
};

double area_of(const TileMesh& mesh) {
  double sum = 0;
  for (std::int32_t t = 0; t < mesh.triangles(); ++t) {
    if (!mesh.stands(t)) continue;
    const auto& n = mesh.triangle(t).nodes;
    const double twice = cross(mesh.point(n[1]) - mesh.point(n[0]), mesh.point(n[2]) - mesh.point(n[0]));
    EXPECT_GT(twice, 0);
    sum += 0.5 * twice;
  }
  return sum;
}

double share_of_unit_edges(const TileMesh& mesh) {
  double unit = 0, all = 0;
  for (const auto& [a, b] : mesh.edges()) {
    const double length = mesh.edge_length(a, b);
    unit += length > std::numbers::sqrt2 / 2 && length < std::numbers::sqrt2 ? 1 : 0;
    ++all;
  }
  return unit / all;
}

TEST(TileMesh, KnowsWhatMayMove) {
  const Ring ring(1);
  EXPECT_EQ(ring.mesh.freedom(0), TileMesh::Freedom::slides);
  EXPECT_EQ(ring.mesh.freedom(Ring::n), TileMesh::Freedom::free);
  EXPECT_EQ(ring.mesh.neighbours_on_wall(0), (std::array<std::int32_t, 2>{1, Ring::n - 1}))
      << "the domain lies to the left";
  std::vector<TileTriangle> part = Ring::triangles();
  part.resize(8);  // what was beyond is not at hand
  const TileMesh mesh(Ring::nodes(1), part, ring.walls);
  EXPECT_EQ(mesh.freedom(0), TileMesh::Freedom::fixed);
  EXPECT_EQ(mesh.freedom(2), TileMesh::Freedom::slides);
  EXPECT_EQ(mesh.freedom(Ring::n + 2), TileMesh::Freedom::fixed);
  EXPECT_TRUE(mesh.edge(Ring::n + 1, Ring::n + 2)->side.locked);
}

TEST(TileMesh, SplitsAWallOnTheOutline) {
  Ring ring(0.1);
  ASSERT_TRUE(split_edge(ring.mesh, 0, 1));
  const std::int32_t m = ring.mesh.nodes() - 1;
  EXPECT_NEAR(length(ring.mesh.point(m)), 1, 1e-3);
  EXPECT_GT(length(ring.mesh.point(m)), std::cos(std::numbers::pi / Ring::n) + 1e-3) << "not on the chord";
  EXPECT_EQ(ring.mesh.freedom(m), TileMesh::Freedom::slides);
  EXPECT_FALSE(ring.mesh.edge(0, 1));
  EXPECT_EQ(ring.mesh.edge(0, m)->side.boundary, 1);
  EXPECT_EQ(ring.mesh.edge(m, 1)->side.boundary, 1);
  EXPECT_LT(ring.mesh.edge(m, Ring::n)->side.boundary, 0);
}

TEST(TileMesh, CollapseTakesBackASplit) {
  Ring ring(0.1);
  const double before = area_of(ring.mesh);
  ASSERT_TRUE(split_edge(ring.mesh, Ring::n, Ring::n + 1));
  const std::int32_t m = ring.mesh.nodes() - 1;
  ASSERT_TRUE(collapse_edge(ring.mesh, m, Ring::n, 100));
  EXPECT_NEAR(area_of(ring.mesh), before, 1e-12);
  Ring wall(0.1);
  ASSERT_TRUE(split_edge(wall.mesh, 0, 1));
  const std::int32_t new_on_wall = wall.mesh.nodes() - 1;
  ASSERT_TRUE(collapse_edge(wall.mesh, new_on_wall, 0, 100));
  const std::int32_t left = wall.mesh.star(0).empty() ? new_on_wall : 0;
  ASSERT_TRUE(wall.mesh.edge(left, 1));
  EXPECT_EQ(wall.mesh.edge(left, 1)->side.boundary, 1);
  EXPECT_EQ(wall.mesh.freedom(left), TileMesh::Freedom::slides);
  EXPECT_FALSE(collapse_edge(wall.mesh, 1, Ring::n + 1, 0.1)) << "a wall's node stays on it";
  EXPECT_FALSE(collapse_edge(wall.mesh, Ring::n, Ring::n + 1, 0.1)) << "edges would be too long";
}

/// Whether a hole of three edges, whose outline bulges to both sides, loses one of them; of the triangles
/// round it the first `shown` are at hand.
bool hole_of_three_closes(std::size_t shown) {
  const std::vector<Point> outline{{-9, -9}, {9, -9},   {9, 9}, {-9, 9},
                                   {-1, 0},  {0, 0.05}, {1, 0}, {0, -0.05}};
  std::vector<BoundaryId> of_segments(4, BoundaryId{0});
  of_segments.resize(8, BoundaryId{1});
  const Geometry geometry{{{"outer"}, {"inner", 0, 180}}, outline, {0, 4, 8}, of_segments};
  const smoother::OutlinePath path(geometry);
  const Walls walls(path, {"outer", "inner"}, {});
  std::vector<TileNode> nodes;
  for (const Point p : {Point{-1, 0}, {1, 0}, {0, 0.05}, {0, 3}, {-3, -3}, {3, -3}})
    nodes.push_back({std::ssize(nodes), p, log_of(isotropic(1))});
  const TileSide wall{1, false};
  std::vector<TileTriangle> triangles{{{1, 3, 2}, {{{}, {}, wall}}},
                                      {{2, 3, 0}, {{{}, {}, wall}}},
                                      {{1, 0, 5}, {{wall, {}, {}}}},
                                      {{0, 4, 5}, {}},
                                      {{1, 5, 3}, {}},
                                      {{0, 3, 4}, {}}};
  triangles.resize(shown);
  TileMesh mesh(nodes, triangles, walls);
  EXPECT_EQ(mesh.freedom(2), TileMesh::Freedom::slides);
  return collapse_edge(mesh, 2, 0, 100);
}

TEST(TileMesh, AHoleKeepsThreeEdges) {
  EXPECT_FALSE(hole_of_three_closes(6));
  EXPECT_FALSE(hole_of_three_closes(2)) << "the third edge is beyond the tile's rim";
}

TEST(TileMesh, FlipsToTheBetterPairOnce) {
  Ring ring(1);
  const double before = area_of(ring.mesh);
  std::int64_t flips = 0;
  for (const auto& [a, b] : ring.mesh.edges()) flips += flip_edge(ring.mesh, a, b) ? 1 : 0;
  for (const auto& [a, b] : ring.mesh.edges()) EXPECT_FALSE(flip_edge(ring.mesh, a, b));
  EXPECT_NEAR(area_of(ring.mesh), before, 1e-12);
}

TEST(AdaptTile, MakesUnitEdgesOnTheOutline) {
  Ring ring(0.15);
  for (int round = 0; round < 4; ++round) adapt_tile(ring.mesh);
  EXPECT_NEAR(area_of(ring.mesh), 8 * std::numbers::pi, 0.02 * 8 * std::numbers::pi);
  EXPECT_GT(share_of_unit_edges(ring.mesh), 0.95);
  for (std::int32_t n = 0; n < ring.mesh.nodes(); ++n) {
    if (ring.mesh.star(n).empty() || ring.mesh.freedom(n) != TileMesh::Freedom::slides) continue;
    const std::int32_t b = ring.mesh.boundary_of(n);
    EXPECT_TRUE(ring.walls.place_of(ring.mesh.point(n), b).valid());
  }
}

TEST(AdaptTile, LeavesFewerNodesWhereTheyAreTooMany) {
  Ring fine(0.15);
  for (int round = 0; round < 3; ++round) adapt_tile(fine.mesh);
  std::vector<TileNode> nodes;
  std::vector<TileTriangle> triangles;
  for (std::int32_t n = 0; n < fine.mesh.nodes(); ++n) {
    nodes.push_back(fine.mesh.node(n));
    nodes.back().metric = log_of(isotropic(0.6));
  }
  for (std::int32_t t = 0; t < fine.mesh.triangles(); ++t) {
    if (fine.mesh.stands(t)) triangles.push_back(fine.mesh.triangle(t));
  }
  TileMesh coarse(nodes, triangles, fine.walls);
  for (int round = 0; round < 4; ++round) adapt_tile(coarse);
  EXPECT_GT(share_of_unit_edges(coarse), 0.9);
  EXPECT_NEAR(area_of(coarse), 8 * std::numbers::pi, 0.05 * 8 * std::numbers::pi);
}

TEST(AdaptTile, EdgesUnderLayersStay) {
  std::vector<double> heights(2 * 16 * Ring::n, 0);
  std::fill(heights.begin() + 16 * Ring::n, heights.end(), 0.01);  // those of the inner circle
  Ring ring(0.15, heights);
  adapt_tile(ring.mesh);
  for (std::int32_t i = 0; i < Ring::n; ++i) {
    EXPECT_EQ(ring.mesh.point(i), Ring::on(1, i));
    EXPECT_TRUE(ring.mesh.edge(i, (i + 1) % Ring::n));
  }
}

TEST(AdaptTile, CrowdsNoNodesOnEdgesThatStay) {
  std::vector<double> heights(2 * 16 * Ring::n, 0);
  std::fill(heights.begin() + 16 * Ring::n, heights.end(), 0.01);
  Ring ring(0.06, heights);  // edges of the inner circle are 0.39 long
  for (int round = 0; round < 3; ++round) adapt_tile(ring.mesh);
  double worst = 1;
  for (std::int32_t t = 0; t < ring.mesh.triangles(); ++t) {
    if (ring.mesh.stands(t)) worst = std::min(worst, ring.mesh.quality(t));
  }
  EXPECT_GT(worst, 0.1);
}

}  // namespace
}  // namespace quadloop::adapt
