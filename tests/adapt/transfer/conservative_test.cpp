// What a conservative transfer owes: integrals to rounding where the new mesh covers the same ground, linear
// functions, no new extrema, and the same bits however the meshes are spread.
#include "adapt/transfer/conservative.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapt/transfer/overlap/overlap_integrals.hpp"
#include "adapt/transfer/overlap/triangle_overlap.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "tests/adapt/transfer/gathered.hpp"
#include "tests/adapt/transfer/jittered_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::gathered;
using test::Grid;
using test::scattered;
using test::world;

using Whole = test::WholeMesh;

Whole jittered(const Grid& grid, std::uint64_t seed, Point by = {}) {
  Whole whole = test::jittered(grid, 0.2, seed);
  for (Point& p : whole.mesh.points) p = p + by;
  return whole;
}

double linear(Point p) { return 1 + 2 * p.x - 3 * p.y; }
double wavy(Point p) { return 2 + std::sin(7 * p.x) * std::cos(9 * p.y); }
double step(Point p) { return p.x + 0.3 * p.y > 0.6 ? 1e5 : 1; }

/// Two variables in the cells, one at the nodes: a function's and numbers without a pattern.
template <class Function>
Field field_with_cells(const Mesh& part, const Function& function) {
  Field field{{"q"}, {}, {3}, {{"a", "b"}, {}}};
  for (std::int32_t node = 0; node < part.owned_nodes; ++node)
    field.values.push_back(function(part.point(NodeId{node})));
  for (const CellShape& shape : cell_shapes(part)) {
    field.cells.values.push_back(function(shape.centroid));
    const double x = 1e3 * shape.centroid.x;
    field.cells.values.push_back(scattered(5, static_cast<std::int64_t>(x * 1e6), 0));
  }
  return field;
}

TEST(TriangleOverlap, OfTrianglesThatCrossOrTouch) {
  const std::array<Point, 3> a{{{0, 0}, {2, 0}, {0, 2}}};
  const TriangleOverlap half = overlap_of(a, {{{1, -1}, {4, -1}, {1, 4}}});
  EXPECT_DOUBLE_EQ(half.area, 0.5);
  EXPECT_NEAR(half.centroid.x, 4.0 / 3, 1e-15);
  EXPECT_NEAR(half.centroid.y, 1.0 / 3, 1e-15);
  EXPECT_DOUBLE_EQ(overlap_of(a, a).area, 2);
  EXPECT_NEAR(overlap_of({{{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}}}, a).area, 0.005, 1e-16);
  EXPECT_NEAR(overlap_of(a, {{{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}}}).area, 0.005, 1e-16);
  EXPECT_EQ(overlap_of(a, {{{2, 0}, {2, 2}, {0, 2}}}).area, 0);
  EXPECT_EQ(overlap_of(a, {{{5, 5}, {6, 5}, {5, 6}}}).area, 0);
  const std::array<Point, 3> star{{{1, 1.5}, {-1, 0.25}, {1.5, -0.5}}};
  EXPECT_NEAR(overlap_of(a, star).area, overlap_of(star, a).area, 1e-15);
}

/// Sides that lie on each other within rounding, exactly on it or on either side.
TEST(TriangleOverlap, OfTrianglesWhoseSidesLieOnEachOther) {
  for (std::int64_t i = 0; i < 2000; ++i) {
    const auto in_unit = [i](int which) { return 0.5 + 0.5 * scattered(7, i, which); };
    const std::array<Point, 3> whole{{{in_unit(0), in_unit(1)}, {5 + in_unit(2), 1 + in_unit(3)}, {2, 6}}};
    const auto& [a, b, c] = whole;
    const Point on_ab = a + in_unit(4) * (b - a), on_bc = b + in_unit(5) * (c - b),
                other = a + in_unit(6) * (b - a);
    const std::array<std::array<Point, 3>, 3> three{{{a, on_ab, c}, {on_ab, b, on_bc}, {on_ab, on_bc, c}}};
    const std::array<std::array<Point, 3>, 2> two{{{a, other, c}, {other, b, c}}};
    double of_whole = 0, by_whole = 0, pairs = 0;
    for (const auto& part : three) {
      of_whole += overlap_of(whole, part).area;
      by_whole += overlap_of(part, whole).area;
      for (const auto& half : two) pairs += overlap_of(part, half).area;
    }
    const double area = area_of(whole);
    ASSERT_NEAR(of_whole / area, 1, 1e-13) << i;
    ASSERT_NEAR(by_whole / area, 1, 1e-13) << i;
    ASSERT_NEAR(pairs / area, 1, 1e-13) << i;
  }
}

TEST(ConservativeTransfer, KeepsIntegralsBetweenSlantedSides) {
  for (const double slope : {0.1, 1 / 3.0, 0.7, 2.3}) {
    const auto slanted = [slope](const Grid& grid, std::uint64_t seed) {
      Whole whole = jittered(grid, seed);
      for (Point& p : whole.mesh.points) p = {p.x - slope * p.y / 7, p.y + slope * p.x};
      return whole;
    };
    const Mesh old_mesh = slanted({23, {1, 1}, true}, 3).part(world()),
               new_mesh = slanted({37, {1, 1}, false}, 4).part(world());
    const Transferred result =
        transfer(world(), old_mesh, field_with_cells(old_mesh, step), new_mesh, TransferKind::conservative);
    for (const double drift : result.report.relative_drift) EXPECT_NEAR(drift, 0, 1e-12) << slope;
    EXPECT_NEAR(result.report.area_change, 0, 1e-13);
  }
}

TEST(ConservativeTransfer, KeepsIntegralsAndExtrema) {
  for (const bool quads : {true, false}) {
    const Whole old_whole = jittered({13, {1, 1}, quads}, 3, {1e4, -7}),
                new_whole = jittered({19, {1, 1}, quads}, 4, {1e4, -7});
    const Mesh old_mesh = old_whole.part(world()), new_mesh = new_whole.part(world());
    const Field old_field = field_with_cells(old_mesh, [](Point p) { return step(p - Point{1e4, -7}); });
    const Transferred result = transfer(world(), old_mesh, old_field, new_mesh, TransferKind::conservative);
    EXPECT_EQ(result.report.outside, 0);
    EXPECT_EQ(result.report.cells_outside, 0);
    ASSERT_EQ(result.report.relative_drift.size(), 3U);
    for (const double drift : result.report.relative_drift) EXPECT_NEAR(drift, 0, 2e-13);
    for (const double value : result.field.values) {
      EXPECT_GE(value, 1);
      EXPECT_LE(value, 1e5);
    }
    ASSERT_EQ(result.field.cells.values.size(), 2 * (new_mesh.triangles.size() + new_mesh.quads.size()));
    const std::vector<double> noise = old_field.cells.column(1);
    const double low = world().minimum(noise.empty() ? 1 : std::ranges::min(noise)),
                 high = world().maximum(noise.empty() ? -1 : std::ranges::max(noise));
    for (std::size_t i = 0; i < result.field.cells.values.size(); i += 2) {
      EXPECT_GE(result.field.cells.values[i], 1);
      EXPECT_LE(result.field.cells.values[i], 1e5);
      EXPECT_GE(result.field.cells.values[i + 1], low);
      EXPECT_LE(result.field.cells.values[i + 1], high);
    }
    EXPECT_EQ(result.field.constants, old_field.constants);
  }
}

TEST(ConservativeTransfer, LinearFunctionsAreExactInside) {
  const Mesh old_mesh = jittered({13, {1, 1}, true}, 3).part(world()),
             new_mesh = jittered({17, {1, 1}, true}, 4).part(world());
  const Transferred result =
      transfer(world(), old_mesh, field_with_cells(old_mesh, linear), new_mesh, TransferKind::conservative);
  const std::vector<CellShape> shapes = cell_shapes(new_mesh);
  const auto inside = [](Point p) { return std::min({p.x, p.y, 1 - p.x, 1 - p.y}) > 0.2; };
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    const Point p = shapes[cell].centroid;
    EXPECT_NEAR(result.field.cells.values[2 * cell], linear(p), inside(p) ? 1e-13 : 0.3);
  }
  // Nodes of new triangles whose own range old triangles bound: all but those at the boundary.
  for (std::int32_t node = 0; node < new_mesh.owned_nodes; ++node) {
    const Point p = new_mesh.point(NodeId{node});
    EXPECT_NEAR(result.field.values[node], linear(p), 1e-12);
  }
}

TEST(ConservativeTransfer, OfTheSameMeshChangesNothing) {
  const Whole whole = jittered({11, {2, 1}, true}, 5);
  Whole again = whole;
  again.order = test::shuffled_order(again.mesh, 9);
  const Mesh mesh = whole.part(world()), new_mesh = again.part(world());
  const Field field = field_with_cells(mesh, step), expected = field_with_cells(new_mesh, step);
  const Transferred result = transfer(world(), mesh, field, new_mesh, TransferKind::conservative);
  EXPECT_EQ(result.field.values, expected.values);
  EXPECT_EQ(result.field.cells.values, expected.cells.values);
}

/// Two nodes of a grid move: values change only where their cells do, and integrals are kept.
TEST(ConservativeTransfer, WhereCellsStayValuesStay) {
  const Communicator alone(MPI_COMM_SELF);
  const Whole before = jittered({16, {1, 1}, true}, 6);
  Whole after = before;
  const std::array<Point, 2> moved{before.mesh.points[5 * 17 + 6] + Point{0.012, 0.004},
                                   before.mesh.points[11 * 17 + 10] + Point{-0.01, 0.01}};
  after.mesh.points[5 * 17 + 6] = moved[0];
  after.mesh.points[11 * 17 + 10] = moved[1];
  after.order = test::shuffled_order(after.mesh, 2);
  const auto transferred = [&](const Communicator& comm) {
    const Mesh old_mesh = before.part(comm);
    return transfer(comm, old_mesh, field_with_cells(old_mesh, wavy), after.part(comm),
                    TransferKind::conservative);
  };
  const Transferred result = transferred(world());
  for (const double drift : result.report.relative_drift) EXPECT_NEAR(drift, 0, 1e-14);
  const Mesh new_mesh = after.part(world());
  const Field unchanged = field_with_cells(new_mesh, wavy);
  NodeFlags near(new_mesh.points.size(), 0);
  new_mesh.for_each_cell([&](const auto& nodes) {
    if (std::ranges::any_of(nodes,
                            [&](NodeId n) { return std::ranges::count(moved, new_mesh.point(n)) > 0; }))
      flag_all(nodes, near);
  });
  const NodeOwners owners(world(), new_mesh.first_node);
  std::vector<GlobalNodeId> flagged;
  for_each_flagged(near, [&](NodeId node) { flagged.push_back(new_mesh.global(node)); });
  flag_at_owners(world(), owners, flagged, near);
  std::int64_t kept = 0;
  for (const NodeId node : ids_below(NodeId{new_mesh.owned_nodes})) {
    if (near[node] != 0) continue;
    EXPECT_EQ(result.field.values[node.value()], unchanged.values[node.value()]);
    ++kept;
  }
  EXPECT_GT(world().sum(kept), 250);
  EXPECT_EQ(gathered(result.field.values), transferred(alone).field.values);
}

TEST(ConservativeTransfer, HasTheSameBitsOnAnyNumberOfRanks) {
  const Communicator alone(MPI_COMM_SELF);
  const Whole old_whole = jittered({12, {1, 1}, true}, 6), new_whole = jittered({15, {1.1, 1}, true}, 8);
  const auto transferred = [&](const Communicator& comm) {
    const Mesh old_mesh = old_whole.part(comm);
    return transfer(comm, old_mesh, field_with_cells(old_mesh, step), new_whole.part(comm),
                    TransferKind::conservative);
  };
  const Transferred one = transferred(alone), many = transferred(world());
  EXPECT_GT(one.report.cells_outside, 0);
  EXPECT_EQ(one.report.cells_outside, many.report.cells_outside);
  EXPECT_EQ(gathered(many.field.values), one.field.values);
  EXPECT_EQ(many.report.drift, one.report.drift);
  const std::size_t triangles = new_whole.part(world()).triangles.size();
  std::vector<double> of_triangles(
      many.field.cells.values.begin(),
      many.field.cells.values.begin() + static_cast<std::ptrdiff_t>(2 * triangles)),
      of_quads(many.field.cells.values.begin() + static_cast<std::ptrdiff_t>(2 * triangles),
               many.field.cells.values.end());
  std::vector<double> all = gathered(of_triangles);
  const std::vector<double> quads = gathered(of_quads);
  all.insert(all.end(), quads.begin(), quads.end());
  EXPECT_EQ(all, one.field.cells.values);
}

TEST(ConservativeTransfer, OutsideTakesTheNearestCell) {
  const Mesh old_mesh = Whole{Grid{4}.mesh(), own_order(Grid{4}.mesh())}.part(world());
  Mesh new_whole = Grid{4}.mesh();
  for (Point& p : new_whole.points) p = p + Point{3, 0};
  const Mesh new_mesh = scatter_mesh(world(), new_whole, own_order(new_whole));
  const Field field = field_with_cells(old_mesh, [](Point p) { return p.x > 0.75 ? 8.0 : 1.0; });
  const Transferred result = transfer(world(), old_mesh, field, new_mesh);
  EXPECT_EQ(result.report.cells_outside, std::ssize(new_whole.triangles) + std::ssize(new_whole.quads));
  for (std::size_t i = 0; i < result.field.cells.values.size(); i += 2)
    EXPECT_EQ(result.field.cells.values[i], 8);
}

}  // namespace
}  // namespace quadloop::adapt
