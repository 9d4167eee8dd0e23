// Places on the curve, pieces of the plane, the nearest boundary, integrals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "adapt/transfer/locate/curve_grid.hpp"
#include "adapt/transfer/locate/nearest_boundary.hpp"
#include "adapt/transfer/locate/triangle_piece.hpp"
#include "adapt/transfer/mesh_integrals.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::scattered, test::world;

Mesh grid_mesh(Point size = {2, 1}) {
  const test::Grid grid{12, size, true};
  Mesh mesh = grid.mesh();
  jitter(grid, 0.2, 5, mesh);
  return mesh;
}

/// A grid from the corner (0, 0) to (1, 1), whatever the number of ranks.
CurveGrid unit_grid() { return {world(), std::vector<Point>{{0, 0}, {1, 1}}}; }

constexpr std::uint32_t last_step = std::numeric_limits<std::uint32_t>::max();

TEST(CurveGrid, KeysFollowTheQuarters) {
  const CurveGrid grid = unit_grid();
  EXPECT_LT(grid.key_of({0.4, 0.4}), grid.key_of({0.6, 0.4}));
  EXPECT_LT(grid.key_of({0.6, 0.4}), grid.key_of({0.4, 0.6}));
  EXPECT_LT(grid.key_of({0.4, 0.6}), grid.key_of({0.6, 0.6}));
  EXPECT_EQ(grid.key_of({0, 0}), 0U);
}

TEST(CurveGrid, WhatLiesOutsideCountsAsTheRim) {
  const CurveGrid grid = unit_grid();
  EXPECT_EQ(grid.key_of({-3, -1}), grid.key_of({0, 0}));
  EXPECT_EQ(grid.key_of({3, 0}), grid.key_of({1, 0}));
  EXPECT_EQ(grid.key_of({1, 1}), std::numeric_limits<std::uint64_t>::max());
  const auto steps = grid.steps_of({{-1, 0.5}, {7, 9}});
  EXPECT_EQ(steps.low.x, 0U);
  EXPECT_EQ(steps.high.x, last_step);
  EXPECT_EQ(steps.low.y, 1U << 31);
}

TEST(CurveGrid, OfOnePointOrNoneIsOneStep) {
  for (const std::vector<Point>& points : {std::vector<Point>{{3, 4}}, std::vector<Point>{}}) {
    const CurveGrid grid(world(), points);
    EXPECT_EQ(grid.key_of({3, 4}), grid.key_of({-1e300, 1e300}));
  }
}

TEST(CurveGrid, TheSquareAroundStepsIsTheSmallest) {
  for (int i = 0; i < 500; ++i) {
    const auto step = [&](int k) {
      return static_cast<std::uint32_t>((scattered(3, i, k) + 1) / 2 * 0x1p32) >> (i % 32);
    };
    const auto [x0, x1] = std::minmax({step(0), step(1)});
    const auto [y0, y1] = std::minmax({step(2), step(3)});
    const CurveGrid::Steps steps{{x0, y0}, {x1, y1}};
    const CurveGrid::Square square = CurveGrid::square_around(steps);
    EXPECT_TRUE(square.meets(steps));
    EXPECT_TRUE(square.begin.x <= x0 && x1 <= square.last().x && square.begin.y <= y0 &&
                y1 <= square.last().y);
    if (square.bits == 0) continue;
    int met = 0;
    for (int k = 0; k < 4; ++k) met += square.child(k).meets(steps) ? 1 : 0;
    EXPECT_GT(met, 1);
  }
}

TEST(CurveGrid, ASquareIsAStretchOfTheCurveInItsChildrensOrder) {
  const CurveGrid::Square square{{4, 8}, 2};
  std::uint64_t next = CurveGrid::key_at(square.begin);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(CurveGrid::key_at(square.child(k).begin), next);
    next = CurveGrid::key_at(square.child(k).last()) + 1;
  }
  EXPECT_EQ(next, CurveGrid::key_at(square.last()) + 1);
  EXPECT_TRUE(square.lies_in({{4, 8}, {7, 11}}));
  EXPECT_FALSE(square.lies_in({{4, 8}, {7, 10}}));
  EXPECT_FALSE(square.meets({{8, 8}, {9, 9}}));
  const CurveGrid::Square all{{0, 0}, 32};
  EXPECT_EQ(all.last().x, last_step);
  EXPECT_EQ(all.child(3).begin.y, 1U << 31);
}

TEST(NearestBoundary, AgreesWithTryingAllEdges) {
  const Mesh whole = grid_mesh(), part = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  const NearestBoundary boundary(world(), part);
  const auto own = boundary_edges_of(part);
  int answers = 0;
  for (int i = 0; i < 200; ++i) {
    const Point p{1 + 2 * scattered(8, i, 0), 0.5 + scattered(8, i, 1)};
    const BoundaryPlace found = boundary.nearest(p);
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : own)
      best = std::min(best, place_on_segment(p, part.point(from), part.point(to)).squared_distance);
    best = world().minimum(best);
    if (found.rank != world().rank()) continue;
    const auto& [from, to] = own.at(found.edge);
    const auto place = place_on_segment(p, part.point(from), part.point(to));
    EXPECT_EQ(place.squared_distance, best);
    EXPECT_EQ(place.parameter, found.parameter);
    ++answers;
  }
  EXPECT_EQ(world().sum(answers), 200) << "one rank for each point";
}

TEST(NearestBoundary, AllRanksFindTheSame) {
  const Mesh whole = grid_mesh(), part = scatter_mesh(world(), whole, space_filling_order(whole));
  const NearestBoundary boundary(world(), part);
  for (const Point p : {Point{1, 0.5}, Point{-1, -1}, Point{9, 0.2}}) {
    const BoundaryPlace found = boundary.nearest(p);
    EXPECT_EQ(world().minimum(std::int64_t{found.rank}), world().maximum(std::int64_t{found.rank}));
    EXPECT_EQ(world().minimum(std::int64_t{found.edge}), world().maximum(std::int64_t{found.edge}));
  }
}

/// x, y of the positions times these, and one more.
Field linear_field(const Mesh& mesh, Point slope, double constant) {
  Field field{{"one", "linear"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    field.values.push_back(1);
    field.values.push_back(constant + dot(slope, mesh.point(NodeId{node})));
  }
  return field;
}

std::vector<double> integrals_of(const Communicator& comm, const Mesh& mesh, const Field& owned) {
  const Field field = with_ghosts(comm, mesh, owned);
  return integrate(comm, mesh, centre_of_nodes(comm, mesh), field);
}

TEST(Integrals, OfLinearFieldsAreExactAndTheSameOnAnyNumberOfRanks) {
  const Mesh whole = grid_mesh();
  const Communicator self(MPI_COMM_SELF);
  for (const MeshOrder& order : {space_filling_order(whole), test::shuffled_order(whole, 9)}) {
    const Mesh part = scatter_mesh(world(), whole, order), alone = scatter_mesh(self, whole, order);
    const auto found = integrals_of(world(), part, linear_field(part, {3, -5}, 0.25));
    EXPECT_NEAR(found[0], 2, 1e-14);
    EXPECT_NEAR(found[1], 2 * (0.25 + 3 * 1 - 5 * 0.5), 1e-13);
    EXPECT_EQ(found, integrals_of(self, alone, linear_field(alone, {3, -5}, 0.25)));
  }
}

TEST(Integrals, OfSizesCountNegativeValuesAsPositive) {
  const Mesh whole = grid_mesh(), mesh = scatter_mesh(world(), whole, space_filling_order(whole));
  const Field field = with_ghosts(world(), mesh, linear_field(mesh, {0, 0}, -3));
  const Point centre = centre_of_nodes(world(), mesh);
  const auto [values, sizes] = integrate_with_sizes(world(), mesh, centre, field);
  EXPECT_EQ(values, integrate(world(), mesh, centre, field));
  EXPECT_EQ(sizes[0], values[0]);
  EXPECT_EQ(sizes[1], -values[1]);
}

TEST(Integrals, OfRectanglesHaveTheSameBitsFromWhicheverCornerTheyAreListed) {
  const Communicator alone(MPI_COMM_SELF);
  Mesh mesh = test::Grid{11, {2, 1}, true}.mesh();  // the middle cell's corners are as far from the centre
  Field field{{"one"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) field.values.push_back(scattered(71, node, 0));
  for (const Point centre : {Point{1, 0.5}, Point{-3, 0.2}, Point{0.3, 7}}) {
    const NodalIntegrals whole_leaves = integrate_with_sizes(alone, mesh, centre, field);
    Mesh turned = mesh;
    for (auto& quad : turned.quads) std::ranges::rotate(quad, quad.begin() + 1);
    const NodalIntegrals quads = integrate_with_sizes(alone, turned, centre, field);
    EXPECT_EQ(whole_leaves.values, quads.values);
    EXPECT_EQ(whole_leaves.sizes, quads.sizes);
  }
}

TEST(TrianglePiece, HasEveryTriangleThatMeetsOnesPieceOfThePlane) {
  const Mesh whole = grid_mesh(), mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 4));
  const CurvePartition shares(world(), std::span(mesh.points).first(mesh.owned_nodes), {});
  const Field field = with_ghosts(world(), mesh, linear_field(mesh, {3, -5}, 0.25));
  const auto own = cell_triangles(world(), mesh, centre_of_nodes(world(), mesh));
  const TrianglePiece piece = gather_piece(world(), shares, mesh, field, own);

  struct Known {
    std::int64_t number;
    std::array<Point, 3> corners;
  };
  std::vector<Known> known;
  for (const CellTriangle& t : own)
    known.push_back({t.number, {mesh.point(t.nodes[0]), mesh.point(t.nodes[1]), mesh.point(t.nodes[2])}});
  std::map<std::int64_t, std::array<Point, 3>> expected;
  for (const Known& k : world().all_gather_values(std::span<const Known>(known))) {
    Box box;
    for (const Point p : k.corners) box.include(p);
    std::vector<int> ranks;
    shares.ranks_meeting(box, ranks);
    if (std::binary_search(ranks.begin(), ranks.end(), world().rank())) expected[k.number] = k.corners;
  }
  EXPECT_EQ(piece.triangles.size(), expected.size());
  for (const CellTriangle& triangle : piece.triangles) {
    EXPECT_EQ(piece.corners(triangle), expected.at(triangle.number));
    for (const NodeId node : triangle.nodes)
      EXPECT_EQ(piece.field.row(node)[1], 0.25 + dot({3, -5}, piece.points[node]));
  }
}

}  // namespace
}  // namespace quadloop::adapt
