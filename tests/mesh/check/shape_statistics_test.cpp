// Distributions of shapes against those worked out by hand.
#include "mesher/mesh/check/shape_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::node;
using test::world;

/// The statistics of a mesh, distributed over the ranks.
ShapeStatistics shape_of(const Mesh& whole, const std::vector<Chain>& geometry) {
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  const HaloMesh halo(world(), mesh);
  return shape_statistics(world(), mesh, halo, edge_statistics(world(), mesh, halo), geometry);
}

/// A unit square and, to its right, a right triangle of half its area.
Mesh square_beside_triangle() {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
  mesh.owned_nodes = 5;
  mesh.quads = {{node(0), node(1), node(2), node(3)}};
  mesh.triangles = {{node(1), node(4), node(2)}};
  return mesh;
}

Point at_degrees(double degrees) { return {1, std::tan(degrees * std::numbers::pi / 180)}; }

/// Triangles with a common tip, of the given angles from the x axis on; they end on the line x = 1.
Mesh fan(std::span<const double> degrees) {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}};
  double sum = 0;
  for (const double angle : degrees) {
    mesh.points.push_back(at_degrees(sum += angle));
    const auto last = size32(mesh.points) - 1;
    mesh.triangles.push_back({node(0), node(last - 1), node(last)});
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}
Mesh fan(std::initializer_list<double> degrees) { return fan(std::span(degrees.begin(), degrees.size())); }

/// The outline of a fan as one loop, counter-clockwise.
std::vector<Chain> wedge(double degrees) {
  return {{"wedge", false, {{0, 0}, {1, 0}, at_degrees(degrees)}, ""}};
}

void expect_excepted_tip(const Mesh& mesh, const std::vector<Chain>& geometry) {
  const ShapeStatistics shape = shape_of(mesh, geometry);
  EXPECT_EQ(shape.corners, 3);
  EXPECT_EQ(shape.corners_of_outline, 1);
  EXPECT_EQ(shape.corners_below_15, 0);
  EXPECT_EQ(shape.corners_below_26, 0);
  EXPECT_NEAR(shape.smallest_degrees, 80, 1e-12);
  EXPECT_NEAR(shape.largest_degrees, 90, 1e-12);
  ASSERT_EQ(shape.sharp_places.size(), 1U);
  EXPECT_EQ(shape.sharp_places[0].place, (Point{0, 0}));
  EXPECT_NEAR(shape.sharp_places[0].degrees, 10, 1e-12);
}

void expect_no_exception(const Mesh& mesh, const std::vector<Chain>& geometry) {
  const ShapeStatistics shape = shape_of(mesh, geometry);
  EXPECT_EQ(shape.corners_of_outline, 0);
  EXPECT_TRUE(shape.sharp_places.empty());
}

TEST(ShapeStatistics, SquareAndTriangle) {
  const ShapeStatistics shape = shape_of(square_beside_triangle(), {});
  EXPECT_EQ(shape.corners, 7);
  EXPECT_EQ(shape.corners_below_15, 0);
  EXPECT_EQ(shape.corners_below_26, 0);
  EXPECT_EQ(shape.corners_above_150, 0);
  EXPECT_NEAR(shape.smallest_degrees, 45, 1e-13);
  EXPECT_NEAR(shape.largest_degrees, 90, 1e-13);
  EXPECT_EQ(shape.area_ratio_max, 2);
  EXPECT_EQ(shape.area_ratio_p99, 2);
  EXPECT_EQ(shape.quad_share, 0.5);
}

TEST(ShapeStatistics, EmptyMeshGivesZeros) {
  const ShapeStatistics shape = shape_of(Mesh{}, wedge(10));
  EXPECT_EQ(shape.corners, 0);
  EXPECT_EQ(shape.corners_of_outline, 0);
  EXPECT_EQ(shape.smallest_degrees, 0);
  EXPECT_EQ(shape.largest_degrees, 0);
  EXPECT_EQ(shape.area_ratio_max, 0);
  EXPECT_EQ(shape.area_ratio_p99, 0);
  EXPECT_EQ(shape.quad_share, 0);
  EXPECT_TRUE(shape.sharp_places.empty());
}

TEST(ShapeStatistics, CountsCornersByTheirAngle) {
  Mesh mesh;  // angles of 14.04, 14.04 and 151.93; then of 22.62, 67.38 and 90
  mesh.points = {{0, 0}, {8, 0}, {4, 1}, {20, 0}, {8, 5}};
  mesh.owned_nodes = 5;
  mesh.triangles = {{node(0), node(1), node(2)}, {node(1), node(3), node(4)}};
  const ShapeStatistics shape = shape_of(mesh, {});
  EXPECT_EQ(shape.corners, 6);
  EXPECT_EQ(shape.corners_below_15, 2);
  EXPECT_EQ(shape.corners_below_26, 3);
  EXPECT_EQ(shape.corners_above_150, 1);
  EXPECT_EQ(shape.area_ratio_max, 0);  // no two cells share an edge
}

TEST(ShapeStatistics, TipCountsWithoutGeometry) {
  const ShapeStatistics shape = shape_of(fan({10}), {});
  EXPECT_EQ(shape.corners_of_outline, 0);
  EXPECT_EQ(shape.corners_below_15, 1);
  EXPECT_EQ(shape.corners_below_26, 1);
  EXPECT_NEAR(shape.smallest_degrees, 10, 1e-12);
  EXPECT_TRUE(shape.sharp_places.empty());
}

TEST(ShapeStatistics, TipOfTheOutlineIsExcepted) { expect_excepted_tip(fan({10}), wedge(10)); }

TEST(ShapeStatistics, ChainsThatMeetAtTheTip) {
  expect_excepted_tip(fan({10}), {{"low", true, {{0, 0}, {1, 0}, at_degrees(10)}, ""},
                                  {"high", true, {at_degrees(10), {0, 0}}, ""}});
}

TEST(ShapeStatistics, RepeatedPointsAtTheTip) {
  expect_excepted_tip(fan({10}), {{"wedge", false, {{0, 0}, {0, 0}, {1, 0}, at_degrees(10), {0, 0}}, ""}});
}

TEST(ShapeStatistics, SmallestCornerOfAPlace) {
  const ShapeStatistics shape = shape_of(fan({20, 8, 12}), wedge(40));
  EXPECT_EQ(shape.corners, 9);
  EXPECT_EQ(shape.corners_of_outline, 3);
  EXPECT_EQ(shape.corners_below_26, 0);
  ASSERT_EQ(shape.sharp_places.size(), 1U);
  EXPECT_NEAR(shape.sharp_places[0].degrees, 8, 1e-12);
}

TEST(ShapeStatistics, WhatTheOutlineDoesNotExcuse) {
  expect_no_exception(fan({40}), wedge(40));  // a corner that is not sharp
  expect_no_exception(fan({20, 35}),
                      {{"blunt", false, {{0, 0}, {2, 0}, 2 * at_degrees(65)}, ""}});  // a vertex that is not
  expect_no_exception(
      fan({10, 40}),
      {{"hole", false, {{0, 0}, at_degrees(50), {1, 0}}, ""}});  // a domain of the other 310 degrees
  expect_no_exception(fan({10, 40}), {{"near", false, {{1e-15, 0}, {1, 0}, at_degrees(50)}, ""}});
  expect_no_exception(fan({10, 40}), {{"loose", true, {{0, 0}, {1, 0}}, ""}});
}

TEST(ShapeStatistics, CornerBetweenTwoBoundaryEdgesIsTheOutlines) {
  expect_excepted_tip(fan({10}), {{"near", false, {{1e-15, 0}, {1, 0}, at_degrees(10)}, ""}});
}

/// A channel of ten squares, 10 long and 1/10 wide, each cut in two, that opens into a square of side 10.
Mesh channel() {
  Mesh mesh;
  for (std::int32_t i = 0; i <= 10; ++i)
    mesh.points.insert(mesh.points.end(), {{1.0 * i, 0}, {1.0 * i, 0.1}});
  for (std::int32_t i = 0; i < 10; ++i) {
    mesh.triangles.push_back({node(2 * i), node(2 * i + 2), node(2 * i + 3)});
    mesh.triangles.push_back({node(2 * i), node(2 * i + 3), node(2 * i + 1)});
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}

TEST(ShapeStatistics, CornersOfCellsThatFillAPassage) {
  const std::vector<Chain> outline{{"banks", false, {{0, 0}, {10, 0}, {10, 0.1}, {0, 0.1}}, ""}};
  const ShapeStatistics shape = shape_of(channel(), outline);
  EXPECT_EQ(shape.corners_in_passages, 18);  // two in each half of a square, but for the halves at the ends,
                                             // of which two edges meet on the boundary
  ASSERT_EQ(shape.passages.size(), 18U);
  EXPECT_EQ(shape.corners_below_15, 2);
  EXPECT_EQ(shape.corners_of_outline, 0);
  EXPECT_EQ(shape_of(channel(), {}).corners_in_passages, 0);
}

/// Unit squares side by side, then one that is three times as long.
Mesh strip(std::int32_t squares) {
  Mesh mesh;
  for (std::int32_t i = 0; i <= squares + 1; ++i) {
    const double x = i <= squares ? i : squares + 3;
    mesh.points.insert(mesh.points.end(), {{x, 0}, {x, 1}});
    if (i > 0) mesh.quads.push_back({node(2 * i - 2), node(2 * i), node(2 * i + 1), node(2 * i - 1)});
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}

TEST(ShapeStatistics, AreaRatioOf99Percent) {
  const ShapeStatistics hundred_edges = shape_of(strip(100), {}), few = shape_of(strip(98), {});
  EXPECT_EQ(hundred_edges.area_ratio_max, 3);
  EXPECT_EQ(hundred_edges.area_ratio_p99, 1);
  EXPECT_EQ(few.area_ratio_p99, 3);  // one edge of 98 is more than 1 percent
  EXPECT_EQ(few.quad_share, 1);
}

TEST(ShapeStatistics, CellWithoutArea) {
  Mesh mesh = square_beside_triangle();
  mesh.points[4] = {1, -1};
  EXPECT_TRUE(std::isinf(shape_of(mesh, {}).area_ratio_max));
}

}  // namespace
}  // namespace quadloop
