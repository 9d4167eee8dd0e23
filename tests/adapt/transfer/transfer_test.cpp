// What a transfer owes: linear fields and old nodes exactly, nothing beyond the old values, the nearest
// boundary outside, and the same bits however the meshes are spread. The references are made by each rank
// alone.
#include "adapt/transfer/transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/adapt/transfer/gathered.hpp"
#include "tests/adapt/transfer/jittered_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::Grid;
using test::scattered;
using test::world;

using test::gathered;
using test::jittered;
using Whole = test::WholeMesh;

Mesh moved(Mesh mesh, Point by) {
  for (Point& p : mesh.points) p = p + by;
  return mesh;
}

/// A field of some variables at the owned nodes of a part, by a function of position and number.
template <class Function>
Field field_of(const Mesh& part, int width, const Function& function) {
  Field field;
  for (int k = 0; k < width; ++k) field.names.push_back("q" + std::to_string(k));
  for (std::int32_t node = 0; node < part.owned_nodes; ++node) {
    for (int k = 0; k < width; ++k)
      field.values.push_back(function(part.point(NodeId{node}), part.first_node + node, k));
  }
  return field;
}

double linear_value(Point p, std::int64_t, int k) {
  return k == 0 ? 3.25 : (k == 1 ? 1 + 2 * p.x - 3 * p.y : 1e5 * (p.x + p.y));
}
double random_value(Point, std::int64_t number, int k) { return scattered(77, number, k); }

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double value : values) result.push_back(std::bit_cast<std::uint64_t>(value));
  return result;
}

/// Points without cells, an even stretch of them for each rank.
Mesh only_points(const Communicator& comm, const std::vector<Point>& points) {
  Mesh mesh;
  const std::size_t rank = static_cast<std::size_t>(comm.rank()),
                    ranks = static_cast<std::size_t>(comm.size());
  const std::size_t begin = points.size() * rank / ranks, end = points.size() * (rank + 1) / ranks;
  mesh.points.assign(points.begin() + static_cast<std::ptrdiff_t>(begin),
                     points.begin() + static_cast<std::ptrdiff_t>(end));
  mesh.first_node = static_cast<std::int64_t>(begin);
  mesh.owned_nodes = static_cast<std::int32_t>(end - begin);
  return mesh;
}

TEST(Transfer, LinearFieldsAreExact) {
  for (const bool quads : {true, false}) {
    const Whole old_whole = jittered({13, {1, 1}, quads}, 0.2, 3),
                new_whole = jittered({17, {1, 1}, quads}, 0.2, 4);
    const Mesh old_mesh = old_whole.part(world()), new_mesh = new_whole.part(world());
    const Transferred result = transfer(world(), old_mesh, field_of(old_mesh, 3, linear_value), new_mesh);
    EXPECT_EQ(result.report.outside, 0);
    const std::vector<double> wanted = field_of(new_mesh, 3, linear_value).values;
    ASSERT_EQ(result.field.values.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double scale = i % 3 == 2 ? 1e5 : 1;
      EXPECT_NEAR(result.field.values[i], wanted[i], i % 3 == 0 ? 0 : 1e-13 * scale) << i;
    }
    ASSERT_EQ(result.report.drift.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(result.report.relative_drift[k], 0, 1e-14);
    EXPECT_NEAR(result.report.drift[2], 0, 1e-9);
  }
}

TEST(Transfer, OldNodesKeepTheirBits) {
  const Whole whole = jittered({11, {2, 1}, true}, 0.2, 5);
  const Mesh old_mesh = whole.part(world());
  Field field = field_of(old_mesh, 2, random_value);
  field.constants = {12, 0.5};
  if (!field.values.empty()) field.values[0] = -0.0;
  const Transferred result = transfer(world(), old_mesh, field, old_mesh);
  EXPECT_EQ(result.field.names, field.names);
  EXPECT_EQ(result.field.constants, field.constants);
  EXPECT_EQ(bits(result.field.values), bits(field.values));
  EXPECT_EQ(result.report.outside, 0);
  EXPECT_EQ(result.report.drift, (std::vector<double>{0, 0}));
  EXPECT_EQ(result.report.relative_drift, (std::vector<double>{0, 0}));
}

/// The triangles of a whole mesh tried one by one: the lowest that holds the point.
const CellTriangle* lowest_with(const std::vector<CellTriangle>& triangles, const Mesh& mesh, Point p) {
  const CellTriangle* lowest = nullptr;
  for (const CellTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.nodes;
    const bool inside = orientation(mesh.point(a), mesh.point(b), p) >= 0 &&
                        orientation(mesh.point(b), mesh.point(c), p) >= 0 &&
                        orientation(mesh.point(c), mesh.point(a), p) >= 0;
    if (inside && (lowest == nullptr || triangle.number < lowest->number)) lowest = &triangle;
  }
  return lowest;
}

TEST(Transfer, TakesTheLowestTriangleAndStaysWithinItsValues) {
  const Communicator alone(MPI_COMM_SELF);
  const Whole old_whole = jittered({9, {1, 1}, true}, 0.2, 6),
              new_whole = jittered({14, {1, 1}, true}, 0.2, 8);
  const Mesh old_mesh = old_whole.part(world()), new_mesh = new_whole.part(world());
  const Transferred result = transfer(world(), old_mesh, field_of(old_mesh, 1, random_value), new_mesh);
  const std::vector<double> old_values = gathered(field_of(old_mesh, 1, random_value).values);
  const Mesh reference = old_whole.part(alone);
  const auto triangles = cell_triangles(alone, reference, centre_of_nodes(alone, reference));
  for (std::int32_t node = 0; node < new_mesh.owned_nodes; ++node) {
    const Point p = new_mesh.point(NodeId{node});
    const CellTriangle* triangle = lowest_with(triangles, reference, p);
    ASSERT_NE(triangle, nullptr);
    std::array<Point, 3> at;
    std::array<double, 3> q{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = reference.point(triangle->nodes[k]);
      q[k] = old_values[triangle->nodes[k].value()];
    }
    const double area = cross(at[1] - at[0], at[2] - at[0]);
    const double wanted = (q[0] * cross(at[1] - p, at[2] - p) + q[1] * cross(at[2] - p, at[0] - p) +
                           q[2] * cross(at[0] - p, at[1] - p)) /
                          area;
    const double value = result.field.values[node];
    EXPECT_NEAR(value, wanted, 1e-13);
    EXPECT_GE(value, std::min({q[0], q[1], q[2]}));
    EXPECT_LE(value, std::max({q[0], q[1], q[2]}));
  }
}

TEST(Transfer, SameBitsHoweverTheMeshesAreSpread) {
  const Communicator alone(MPI_COMM_SELF);
  const Whole old_whole = jittered({12, {1, 1}, true}, 0.2, 9);
  Whole new_whole = jittered({15, {1.2, 1.1}, true}, 0.1, 10);  // reaches beyond the old mesh
  new_whole.mesh = moved(new_whole.mesh, {-0.1, -0.05});
  const auto run = [&](const Communicator& comm) {
    const Mesh old_mesh = old_whole.part(comm), new_mesh = new_whole.part(comm);
    return transfer(comm, old_mesh, field_of(old_mesh, 3, random_value), new_mesh);
  };
  const Transferred here = run(world()), reference = run(alone);
  EXPECT_GT(here.report.outside, 0);
  EXPECT_EQ(here.report.outside, reference.report.outside);
  EXPECT_EQ(bits(gathered(here.field.values)), bits(reference.field.values));
  EXPECT_EQ(bits(here.report.drift), bits(reference.report.drift));
  EXPECT_EQ(bits(here.report.relative_drift), bits(reference.report.relative_drift));
}

/// On nodes and in the middle of edges of a regular grid, several triangles hold a point.
TEST(Transfer, PointsOnEdgesAndNodesHaveOneAnswer) {
  const Communicator alone(MPI_COMM_SELF);
  const Grid grid{8, {8, 8}, true};
  const Whole whole{grid.mesh(), test::shuffled_order(grid.mesh(), 2)};
  std::vector<Point> points;
  for (int i = 0; i <= 16; ++i) {
    for (int j = 0; j <= 16; ++j) points.push_back({0.5 * i, 0.5 * j});
  }
  const auto run = [&](const Communicator& comm) {
    const Mesh old_mesh = whole.part(comm);
    return transfer(comm, old_mesh, field_of(old_mesh, 2, random_value), only_points(comm, points));
  };
  const Transferred here = run(world()), reference = run(alone);
  EXPECT_EQ(here.report.outside, 0);
  EXPECT_EQ(bits(gathered(here.field.values)), bits(reference.field.values));
}

TEST(Transfer, OutsideTakesTheNearestBoundaryValue) {
  const Whole old_whole = jittered({10, {1, 1}, true}, 0.2, 11);
  Whole new_whole = jittered({20, {2, 2}, true}, 0, 12);
  new_whole.mesh = moved(new_whole.mesh, {-0.5, -0.5});
  const Mesh old_mesh = old_whole.part(world()), new_mesh = new_whole.part(world());
  const Transferred result = transfer(world(), old_mesh, field_of(old_mesh, 3, linear_value), new_mesh);
  std::int64_t outside = 0;
  for (std::int32_t node = 0; node < new_mesh.owned_nodes; ++node) {
    const Point p = new_mesh.point(NodeId{node}),
                nearest{std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0)};
    outside += p == nearest ? 0 : 1;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(result.field.values[3 * node + k], linear_value(nearest, 0, k), 1e-13 * (k == 2 ? 1e5 : 1));
    }
  }
  EXPECT_EQ(result.report.outside, world().sum(outside));
  EXPECT_NEAR(result.report.drift[0], 3.25 * 3, 1e-12);  // the constant, over an area of 4 less 1
  EXPECT_NEAR(result.report.relative_drift[0], 3, 1e-12);
}

TEST(Transfer, DriftIsAShareOfTheAbsoluteIntegral) {
  const Mesh whole = Grid{2, {2, 2}, true}.mesh();
  const Mesh mesh = Whole{whole, space_filling_order(whole)}.part(world());
  const auto values = [](Point p, std::int64_t, int k) { return k == 0 ? 2.0 : (k == 1 ? -2.0 : p.x - 1); };
  const Mesh larger = Whole{moved(whole, {2, 0}), space_filling_order(whole)}.part(
      world());  // takes the values of the side x = 2
  const Transferred result = transfer(world(), mesh, field_of(mesh, 3, values), larger);
  EXPECT_EQ(result.report.outside, 6);
  EXPECT_EQ(result.report.drift, (std::vector<double>{0, 0, 4}));
  EXPECT_EQ(result.report.relative_drift, (std::vector<double>{0, 0, 2}));  // |x - 1| over [0, 2]^2 is 2
}

/// A ring of eight squares round a hole from (1, 1) to (2, 2).
Mesh ring() {
  Mesh mesh = Grid{3, {3, 3}, true}.mesh();
  mesh.triangles.clear();
  mesh.quads.clear();
  const auto at = [](std::int32_t i, std::int32_t j) { return NodeId{4 * j + i}; };
  for (std::int32_t j = 0; j < 3; ++j) {
    for (std::int32_t i = 0; i < 3; ++i) {
      if (i != 1 || j != 1) mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  mesh.boundaries.push_back(
      {"hole",
       "wall",
       {{at(2, 1), at(1, 1)}, {at(1, 1), at(1, 2)}, {at(1, 2), at(2, 2)}, {at(2, 2), at(2, 1)}}});
  return mesh;
}

TEST(Transfer, InAHoleTheLowestOfTheNearestEdgesWins) {
  const Mesh whole = ring();
  const Whole spread{whole, space_filling_order(whole)};
  const Mesh old_mesh = spread.part(world());
  const auto by_place = [](Point p, std::int64_t, int) { return 10 * p.x + p.y; };
  const std::vector<Point> points{{1.5, 1.5}, {1.25, 1.25}, {1.5, 1.75}, {1, 1.5}};
  const Transferred result =
      transfer(world(), old_mesh, field_of(old_mesh, 1, by_place), only_points(world(), points));
  EXPECT_EQ(result.report.outside, 3);  // the last lies on the rim
  EXPECT_EQ(gathered(result.field.values), (std::vector<double>{16, 13.5, 17, 11.5}));
}

/// All of one mesh on the last rank, all of the other on the first.
TEST(Transfer, RanksMayHaveNothing) {
  const Communicator alone(MPI_COMM_SELF);
  const Whole old_whole = jittered({6, {1, 1}, true}, 0.2, 13),
              new_whole = jittered({7, {1.5, 1}, true}, 0.2, 14);
  const auto only_on = [&](int rank, const Whole& whole) {
    const Mesh all = whole.part(alone);
    if (world().rank() == rank) return all;
    Mesh none;
    none.first_node = world().rank() < rank ? 0 : all.owned_nodes;
    for (const BoundaryEdges& boundary : all.boundaries)
      none.boundaries.push_back({boundary.name, boundary.condition, {}});
    return none;
  };
  const Mesh old_mesh = only_on(world().size() - 1, old_whole), new_mesh = only_on(0, new_whole);
  const Transferred here = transfer(world(), old_mesh, field_of(old_mesh, 2, random_value), new_mesh);
  const Mesh old_alone = old_whole.part(alone);
  const Transferred reference =
      transfer(alone, old_alone, field_of(old_alone, 2, random_value), new_whole.part(alone));
  EXPECT_EQ(bits(gathered(here.field.values)), bits(reference.field.values));
  EXPECT_EQ(bits(here.report.drift), bits(reference.report.drift));
}

TEST(Transfer, WithoutVariablesOrNewNodesThereIsNothingToDo) {
  const Whole whole = jittered({4, {1, 1}, true}, 0.2, 15);
  const Mesh mesh = whole.part(world());
  const Transferred none = transfer(world(), mesh, {}, mesh);
  EXPECT_TRUE(none.field.values.empty());
  EXPECT_TRUE(none.report.drift.empty());
  const Transferred nowhere =
      transfer(world(), mesh, field_of(mesh, 1, linear_value), only_points(world(), {}));
  EXPECT_TRUE(nowhere.field.values.empty());
  EXPECT_NEAR(nowhere.report.relative_drift.at(0), -1, 1e-15);
}

/// Two blocks with the interface moved by a wave, which another mesh's chords do not follow.
Mesh wavy_blocks(std::int32_t n) {
  Mesh whole = test::two_blocks({n});
  for (Point& p : whole.points) p.x += 0.04 * std::sin(40 * p.y) * p.x * (1 - p.x);
  return whole;
}

TEST(Transfer, NoValueCrossesAnInterface) {
  const Mesh old_whole = wavy_blocks(8), new_whole = wavy_blocks(14);
  const Mesh old_mesh = test::part_with_blocks(world(), old_whole, test::shuffled_order(old_whole, 3)),
             new_mesh = test::part_with_blocks(world(), new_whole, test::shuffled_order(new_whole, 4));
  Field field{{}, {}, {}, {{"T"}, {}}};
  const auto put_blocks = [](const Mesh& mesh, std::vector<double>& values) {
    for (const auto* blocks : {&mesh.blocks.of_triangles, &mesh.blocks.of_quads})
      for (const std::int32_t block : *blocks) values.push_back(300.0 + 100 * block);
  };
  put_blocks(old_mesh, field.cells.values);
  std::vector<double> wanted;
  put_blocks(new_mesh, wanted);
  const Transferred result = transfer(world(), old_mesh, field, new_mesh);
  ASSERT_EQ(result.field.cells.values.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(result.field.cells.values[i], wanted[i], 1e-10);
}

TEST(Transfer, NodesOfBlocksAreExactForLinearFields) {
  const Mesh old_whole = test::two_blocks({8}), new_whole = test::two_blocks({14});
  const Mesh old_mesh = test::part_with_blocks(world(), old_whole, test::shuffled_order(old_whole, 3)),
             new_mesh = test::part_with_blocks(world(), new_whole, test::shuffled_order(new_whole, 4));
  const Transferred result = transfer(world(), old_mesh, field_of(old_mesh, 2, linear_value), new_mesh);
  const std::vector<double> wanted = field_of(new_mesh, 2, linear_value).values;
  ASSERT_EQ(result.field.values.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(result.field.values[i], wanted[i], 1e-13);
  EXPECT_THROW(transfer(world(), old_mesh, field_of(old_mesh, 1, linear_value),
                        scatter_mesh(world(), new_whole, own_order(new_whole))),
               InputError);
}

}  // namespace
}  // namespace quadloop::adapt
