#include "mesher/mesh/periodic_mesh.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/periodic_images.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

const PeriodicPair to_the_east{"west", "east", {4, 0}}, to_the_north{"south", "north", {0, 4}},
    turned{"low", "high", {}, 90, {1, 0}};

TEST(PeriodicMaps, ShiftsAddUp) {
  const PeriodicMaps maps({to_the_east, to_the_north, {"up", "down", {0, -4}}});
  const PeriodicShift east = maps.of_pair(0), north = maps.of_pair(1);
  EXPECT_EQ(maps.of_pair(2), -north) << "the inverse of another pair";
  EXPECT_EQ(maps.image(east + north, {1, 2}), (Point{5, 6}));
  EXPECT_EQ(maps.image(2 * east - north, {1, 2}), (Point{9, -2}));
  EXPECT_EQ(maps.image(0, {1, 2}), (Point{1, 2}));
  EXPECT_EQ(maps.degrees(east - north), 0);
}

TEST(PeriodicMaps, ARotationTurnsVectors) {
  const PeriodicMaps maps({turned});
  const PeriodicShift shift = maps.of_pair(0);
  EXPECT_EQ(maps.degrees(shift), 90);
  EXPECT_EQ(maps.degrees(-shift), -90);
  const Point back = maps.image(-shift, maps.image(shift, {2, 0.5}));
  EXPECT_NEAR(back.x, 2, 1e-15);
  EXPECT_NEAR(back.y, 0.5, 1e-15);
}

TEST(PeriodicMaps, RefusesMapsThatDoNotCommute) {
  EXPECT_THROW(PeriodicMaps({turned, to_the_east}), InputError);
  EXPECT_THROW(PeriodicMaps({{"a", "b", {1, 0}}, {"c", "d", {2, 0}}, {"e", "f", {3, 0}}, {"g", "h", {5, 0}}}),
               InputError);
}

TEST(PeriodicImages, ANumberTellsNodeAndShift) {
  const PeriodicMaps maps({to_the_east, to_the_north});
  const GlobalNodeId node{123456789};
  for (const PeriodicShift shift :
       {0, maps.of_pair(0), -maps.of_pair(0), maps.of_pair(1) - 2 * maps.of_pair(0)}) {
    const GlobalNodeId image = image_number(node, shift);
    EXPECT_EQ(original_of(image), node);
    EXPECT_EQ(shift_of(image), shift);
    EXPECT_EQ(shifted(image, -shift), node);
  }
  EXPECT_EQ(image_number(node, 0), node);
}

/// A square of 4 x 4 cells with pairs in both directions, on all ranks.
Mesh torus() {
  const test::Grid grid{4, {4, 4}};
  Mesh whole = grid.mesh();
  for (std::int32_t node = 0; node < whole.owned_nodes; ++node) {
    if (grid.inner(node)) whole.points[node].x += 0.2 * test::scattered(4, node, 0);
  }
  std::vector<BoundaryEdges> sides;
  for (const char* name : {"south", "north", "west", "east"}) sides.push_back({name, {}, {}});
  for (const BoundaryEdges& boundary : whole.boundaries) {
    for (const auto& edge : boundary.edges) {
      const Point middle = 0.5 * (whole.point(edge[0]) + whole.point(edge[1]));
      const std::size_t side = middle.y == 0 ? 0 : middle.y == 4 ? 1 : middle.x == 0 ? 2 : 3;
      sides[side].edges.push_back(edge);
    }
  }
  whole.boundaries = sides;
  Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  mesh.pairs = {to_the_east, to_the_north};
  return mesh;
}

TEST(PeriodicMesh, OneOfTheNodesThatBelongTogetherRemains) {
  const PeriodicMesh joined = join_pairs(world(), torus());
  EXPECT_EQ(world().sum(joined.mesh.owned_nodes), 16)
      << "25 nodes, of which 8 have one partner and 1 has three";
  EXPECT_EQ(world().sum(std::ssize(joined.mesh.triangles) + 2 * std::ssize(joined.mesh.quads)), 32);
  for (const BoundaryEdges& boundary : joined.mesh.boundaries) EXPECT_TRUE(boundary.edges.empty());
  EXPECT_TRUE(joined.mesh.pairs.empty());
}

TEST(PeriodicMesh, ImagesAreWhereTheirPartnersWere) {
  const PeriodicMesh joined = join_pairs(world(), torus());
  const Mesh& mesh = joined.mesh;
  for (std::int32_t i = mesh.owned_nodes; i < size32(mesh.points); ++i) {
    const NodeId node{i};
    const PeriodicShift shift = shift_of(mesh.global(node));
    EXPECT_EQ(joined.maps.image(shift, joined.originals[i]), mesh.point(node));
  }
}

/// Twice the area by the diagonals, or of a triangle.
template <class Corners>
double extent_of(const Corners& p) {
  return p.size() == 4 ? cross(p[2] - p[0], p.back() - p[1]) : cross(p[1] - p[0], p[2] - p[0]);
}

TEST(PeriodicMesh, ValuesOfCellsReachTheOtherSides) {
  const PeriodicMesh joined = join_pairs(world(), torus());
  std::vector<double> own, expected;
  joined.mesh.for_each_cell(
      [&](const auto& nodes) { own.push_back(extent_of(corners_of(joined.mesh, nodes))); });
  const HaloMesh halo(world(), joined);
  halo.for_each_cell([&](const auto& nodes) { expected.push_back(extent_of(corners_of(halo, nodes))); });
  const std::vector<double> found = halo.spread(world(), own);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

TEST(PeriodicMesh, SidesHaveTheirEdgesIfTheyAreKept) {
  const PeriodicMesh joined = join_pairs(world(), torus(), SideEdges::kept);
  const PeriodicShift east = joined.maps.of_pair(0);
  EXPECT_EQ(joined.opposite[2].boundary, 3);
  EXPECT_EQ(joined.opposite[2].shift, east);
  EXPECT_EQ(joined.opposite[3].boundary, 2);
  EXPECT_EQ(joined.opposite[3].shift, -east);
  const HaloMesh halo(world(), joined);
  std::int32_t leaving = 0;
  for (const HaloEdge& edge : halo.edges_in_place()) {
    if (edge.boundary == 2 && halo.owns(edge.from)) ++leaving;
  }
  EXPECT_EQ(world().sum(std::int64_t{leaving}), 3) << "the fourth leaves an image of the corner";
}

TEST(PeriodicMesh, RefusesNodesThatDoNotMatch) {
  Mesh mesh = torus();
  mesh.pairs = {{"west", "east", {4.5, 0}}};
  EXPECT_THROW(join_pairs(world(), mesh), InputError);
}

}  // namespace
}  // namespace quadloop
