// Figures against those worked out by hand, on any number of ranks.
#include "mesher/mesh/check/quality.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::node;
using test::world;

TEST(Quality, OfTriangles) {
  const std::array<Point, 3> equilateral{Point{0, 0}, Point{1, 0}, Point{0.5, std::sqrt(3.0) / 2}},
      right{Point{0, 0}, Point{1, 0}, Point{0, 1}}, flat{Point{0, 0}, Point{1, 0}, Point{2, 0}},
      inverted{Point{0, 0}, Point{0, 1}, Point{1, 0}}, nothing{};
  EXPECT_NEAR(quality_of(equilateral), 1, 1e-15);
  EXPECT_NEAR(quality_of(right), std::sqrt(3.0) / 2, 1e-15);  // 4 sqrt(3) (1/2) / (1 + 1 + 2)
  EXPECT_EQ(quality_of(flat), 0);
  EXPECT_NEAR(quality_of(inverted), -std::sqrt(3.0) / 2, 1e-15);
  EXPECT_EQ(quality_of(nothing), 0);
}

TEST(Quality, OfQuads) {
  const std::array<Point, 4> unit{Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}},
      oblong{Point{0, 0}, Point{2, 0}, Point{2, 1}, Point{0, 1}},
      dart{Point{0, 0}, Point{1, 0}, Point{0.25, 0.25}, Point{0, 1}};
  EXPECT_EQ(quality_of(unit), 1);
  EXPECT_NEAR(quality_of(oblong), 0.8, 1e-15);  // 2 * 2 / (4 + 1)
  EXPECT_LT(quality_of(dart), 0);
}

TEST(Quality, OfCorners) {
  EXPECT_NEAR(corner_degrees({0, 1}, {0, 0}, {1, 0}), 90, 1e-13);
  EXPECT_NEAR(corner_degrees({1, 1}, {0, 0}, {1, 0}), 45, 1e-13);
  EXPECT_NEAR(corner_degrees({-1, 0}, {0, 0}, {1, 0}), 180, 1e-13);
  EXPECT_NEAR(corner_degrees({0, -1}, {0, 0}, {1, 0}), -90, 1e-13);
}

/// A unit square and a right triangle to its right, on every rank one beside the other.
Mesh square_and_triangle() {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
  mesh.owned_nodes = 5;
  mesh.first_node = 5 * world().rank();
  mesh.quads = {{node(0), node(1), node(2), node(3)}};
  mesh.triangles = {{node(1), node(4), node(2)}};
  mesh.boundaries = {
      {"b",
       "wall",
       {{node(0), node(1)}, {node(1), node(4)}, {node(4), node(2)}, {node(2), node(3)}, {node(3), node(0)}}}};
  return mesh;
}

TEST(Quality, SummaryOverRanks) {
  const Mesh mesh = square_and_triangle();
  const QualitySummary summary = summarise_quality(world(), mesh);
  EXPECT_EQ(summary.counts.nodes, 5 * world().size());
  EXPECT_EQ(summary.counts.triangles, world().size());
  EXPECT_EQ(summary.counts.quads, world().size());
  EXPECT_EQ(summary.counts.boundary_edges, 5 * world().size());
  EXPECT_NEAR(summary.smallest_degrees, 45, 1e-13);
  EXPECT_NEAR(summary.largest_degrees, 90, 1e-13);
  EXPECT_NEAR(summary.worst, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(summary.mean, (1 + std::sqrt(3.0) / 2) / 2, 1e-9);
  EXPECT_EQ(summary.mean, summarise_quality(Communicator(MPI_COMM_SELF), mesh).mean);
  EXPECT_DOUBLE_EQ(area_of(mesh), 1.5);
}

TEST(Quality, EmptyMeshAndEmptyRanks) {
  const QualitySummary nothing = summarise_quality(world(), Mesh{});
  EXPECT_EQ(nothing.smallest_degrees, 0);
  EXPECT_EQ(nothing.worst, 0);
  EXPECT_EQ(nothing.mean, 0);
  const QualitySummary one = summarise_quality(world(), world().is_root() ? square_and_triangle() : Mesh{});
  EXPECT_NEAR(one.smallest_degrees, 45, 1e-13);
  EXPECT_EQ(one.counts.quads, 1);
}

}  // namespace
}  // namespace quadloop
