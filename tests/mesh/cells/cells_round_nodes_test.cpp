// What cells round a node tell of their means, on any number of ranks as on one.
#include "mesher/mesh/cells/cells_round_nodes.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

double linear(Point p) { return 3 - 2 * p.x + 5 * p.y; }

Mesh jittered_far_off(std::int32_t n) {
  const test::Grid grid{n, {4, 1}};
  Mesh whole = grid.mesh();
  test::jitter(grid, 0.2, 9, whole);
  for (Point& p : whole.points) p = p + Point{1000, -50};
  return whole;
}

std::vector<double> means(const Mesh& mesh) {
  std::vector<double> values;
  for (const CellShape& shape : cell_shapes(mesh)) values.push_back(linear(shape.centroid));
  return values;
}

TEST(CellShape, OfAQuadIsThatOfItsTriangles) {
  const std::vector<Point> corners{{10, 10}, {12, 10}, {13, 14}, {10, 11}};
  const CellShape a = shape_of(std::vector{corners[0], corners[1], corners[2]}),
                  b = shape_of(std::vector{corners[0], corners[2], corners[3]}), whole = shape_of(corners);
  EXPECT_DOUBLE_EQ(whole.area, a.area + b.area);
  EXPECT_NEAR(whole.centroid.x, (a.area * a.centroid.x + b.area * b.centroid.x) / whole.area, 1e-14);
  EXPECT_NEAR(whole.centroid.y, (a.area * a.centroid.y + b.area * b.centroid.y) / whole.area, 1e-14);
  EXPECT_NEAR(a.centroid.x, 35.0 / 3, 1e-14);
  EXPECT_EQ(shape_of(std::vector<Point>{{0, 0}, {1, 0}, {2, 0}}).centroid, (Point{1, 0}));
}

TEST(CellsRoundNodes, TellTheGradientOfALinearFunction) {
  const Mesh part = scatter_mesh(world(), jittered_far_off(9), space_filling_order(jittered_far_off(9)));
  const std::vector<AroundNode> around = CellsRoundNodes(world(), part).of(means(part));
  ASSERT_EQ(around.size(), part.points.size());
  std::int64_t with_gradient = 0;
  for (std::int32_t node = 0; node < part.owned_nodes; ++node) {
    const double here = linear(part.points[node]);
    if (around[node].has_gradient) {
      ++with_gradient;
      EXPECT_NEAR(around[node].gradient.x, -2, 1e-9);
      EXPECT_NEAR(around[node].gradient.y, 5, 1e-9);
    }
    EXPECT_LE(around[node].smallest, around[node].largest);
    EXPECT_LE(around[node].smallest, here + 5);
  }
  EXPECT_GE(world().sum(with_gradient), 64);  // those inside; on the sides two quads lie on one line
}

TEST(CellsRoundNodes, HaveTheSameBitsOnAnyNumberOfRanks) {
  const Mesh whole = jittered_far_off(8);
  std::vector<double> of_whole;
  for (std::int64_t cell = 0; cell < std::ssize(means(whole)); ++cell)
    of_whole.push_back(test::scattered(4, cell, 0));
  const Communicator alone(MPI_COMM_SELF);
  const std::vector<AroundNode> expected = CellsRoundNodes(alone, whole).of(of_whole);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const Field spread = scatter_field(world(), {{}, {}, {}, {{"q"}, of_whole}}, part, own_order(whole));
  const std::vector<AroundNode> around = CellsRoundNodes(world(), part).of(spread.cells.values);
  for (std::int32_t node = 0; node < std::ssize(part.points); ++node) {
    const AroundNode &here = around[node], &there = expected[part.global(NodeId{node}).value()];
    EXPECT_EQ(here.gradient, there.gradient);
    EXPECT_EQ(here.has_gradient, there.has_gradient);
    EXPECT_EQ(here.smallest, there.smallest);
    EXPECT_EQ(here.largest, there.largest);
  }
}

TEST(CellOwners, BringRowsOfCellsAnywhere) {
  const Mesh whole = jittered_far_off(6);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const CellOwners owners(world(), part);
  std::vector<std::int64_t> rows, asked;
  for (std::int64_t cell = 0; cell < std::ssize(part.triangles) + std::ssize(part.quads); ++cell) {
    EXPECT_EQ(owners.local(owners.number(cell)), cell);
    EXPECT_EQ(owners.rank_of(owners.number(cell)), world().rank());
    rows.insert(rows.end(), {owners.number(cell), -owners.number(cell)});
  }
  const std::int64_t all = std::ssize(whole.triangles) + std::ssize(whole.quads);
  for (std::int64_t cell = all; cell-- > 0;) asked.push_back(cell);
  const auto brought = rows_of_cells(world(), owners, std::span<const std::int64_t>(asked), rows, 2);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(brought[2 * i], asked[i]);
    EXPECT_EQ(brought[2 * i + 1], -asked[i]);
  }
}

}  // namespace
}  // namespace quadloop
