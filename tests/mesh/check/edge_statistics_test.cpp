// What is found at the edges of meshes, distributed over the ranks.
#include "mesher/mesh/check/edge_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/mixed_square.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::mixed_square;
using test::node;
using test::world;

EdgeStatistics edges_of(const Mesh& whole) {
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  return edge_statistics(world(), mesh, HaloMesh(world(), mesh));
}

/// Rows of unit squares, of `length` squares each, that do not touch.
Mesh rows(std::initializer_list<std::int32_t> lengths) {
  Mesh mesh;
  double y = 0;
  for (const std::int32_t length : lengths) {
    const std::int32_t first = size32(mesh.points);
    for (std::int32_t i = 0; i <= length; ++i) {
      mesh.points.insert(mesh.points.end(), {{1.0 * i, y}, {1.0 * i, y + 1}});
      const std::int32_t n = first + 2 * i;
      if (i > 0) mesh.quads.push_back({node(n - 2), node(n), node(n + 1), node(n - 1)});
    }
    y += 2;
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}

TEST(EdgeStatistics, RegionsAreConnectedByEdges) {
  const Mesh one = mixed_square();
  const EdgeStatistics whole = edges_of(one);
  EXPECT_EQ(whole.regions.count, 1);
  EXPECT_EQ(whole.regions.smallest_cells, std::ssize(one.triangles) + std::ssize(one.quads));
  EXPECT_EQ(whole.pinched_nodes, 0);
  Mesh two = one;  // a triangle that shares a node alone with the others
  two.points.push_back({3, 2.5});
  two.points.push_back({2.5, 3});
  two.owned_nodes += 2;
  two.triangles.push_back({node(8), node(9), node(10)});
  const EdgeStatistics divided = edges_of(two);
  EXPECT_EQ(divided.regions.count, 2);
  EXPECT_EQ(divided.regions.smallest_cells, 1);
  EXPECT_EQ(divided.regions.smallest_place, two.points[8]);
  EXPECT_EQ(divided.pinched_nodes, 1);
}

TEST(EdgeStatistics, OfEqualRegionsTheFirstIsNamed) {
  const MeshRegions regions = edges_of(rows({7, 3, 9, 3, 20, 3})).regions;
  EXPECT_EQ(regions.count, 6);
  EXPECT_EQ(regions.smallest_cells, 3);
  EXPECT_EQ(regions.smallest_place, (Point{0, 2}));
}

TEST(EdgeStatistics, LargestRatioIsThatOfTheFirstCell) {
  Mesh mesh = rows({20, 20});
  for (const std::size_t i : {26U, 27U, 42U + 12U, 42U + 13U}) mesh.points[i].x += 0.5;  // 1.5 and 0.5 long
  EXPECT_EQ(edges_of(mesh).ratios.largest, 3);
  EXPECT_EQ(edges_of(mesh).ratios.place, (Point{13.5, 0.5}));
  std::ranges::reverse(mesh.quads);
  EXPECT_EQ(edges_of(mesh).ratios.place, (Point{6.5, 2.5}));
}

TEST(EdgeStatistics, ACellWithoutAreaHasAnInfiniteRatio) {
  Mesh mesh = rows({2});
  mesh.points[4] = mesh.points[2];
  mesh.points[5] = mesh.points[3];
  EXPECT_TRUE(std::isinf(edges_of(mesh).ratios.largest));
  EXPECT_EQ(edges_of(mesh).ratios.place, (Point{1, 0.5}));
}

TEST(EdgeStatistics, RatioOf99Percent) {
  Mesh mesh = rows({101});
  for (const std::size_t last : {202U, 203U}) mesh.points[last].x += 2;
  const AreaRatios of_hundred = area_ratios(world(), scatter_mesh(world(), mesh, own_order(mesh)));
  EXPECT_EQ(of_hundred.largest, 3);
  EXPECT_EQ(of_hundred.of_99_percent, 1);
  EXPECT_EQ(area_ratios(world(), Mesh{}).largest, 0) << "no inner edge";
}

TEST(EdgeStatistics, BoundaryIsSeenFromItsNodes) {
  const Mesh whole = mixed_square();
  std::int64_t edges = 0, own = 0;
  for (const BoundaryEdges& boundary : whole.boundaries) edges += std::ssize(boundary.edges);
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  const HaloMesh halo(world(), mesh);
  for (const OneSidedEdge& edge : edge_statistics(world(), mesh, halo).one_sided)
    own += halo.owns(edge.from) ? 1 : 0;
  EXPECT_EQ(world().sum(own), edges);
}

}  // namespace
}  // namespace quadloop
