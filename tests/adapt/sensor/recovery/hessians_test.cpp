// Hessians recovered from values at nodes and in cells: exact for quadratics, at walls and hanging nodes too,
// along rows alone in layers, the same bits on any number of ranks.
#include "adapt/sensor/recovery/hessians.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adapt/sensor/recovery/moments.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;
using Function = std::function<double(Point)>;

ScaledField at_nodes(const Mesh& mesh, const Function& value) {
  ScaledField field;
  for (const Point p : mesh.points) field.values.push_back(value(p));
  return field;
}

double quadratic(Point p) { return 3 + 2 * p.x - p.y + 0.5 * p.x * p.x - 3 * p.x * p.y - 2 * p.y * p.y; }
constexpr Hessian of_quadratic{1, -3, -4};

void expect_near(const Hessian& found, const Hessian& expected, double tolerance) {
  EXPECT_NEAR(found.xx, expected.xx, tolerance);
  EXPECT_NEAR(found.xy, expected.xy, tolerance);
  EXPECT_NEAR(found.yy, expected.yy, tolerance);
}

TEST(Hessian, HasAbsoluteEigenvalues) {
  EXPECT_DOUBLE_EQ(largest_eigenvalue({3, 0, -7}), 7);
  EXPECT_DOUBLE_EQ(largest_eigenvalue({1, 2, 1}), 3);
  expect_near(absolute({3, 0, -7}), {3, 0, 7}, 1e-15);
  expect_near(absolute({1, 2, 1}), {2, 1, 2}, 1e-15);  // 3 along (1, 1), -1 across
  expect_near(absolute({-2, 1, -2}), {2, -1, 2}, 1e-15);
  expect_near(absolute({0, 0, 0}), {0, 0, 0}, 0);
  EXPECT_DOUBLE_EQ(along({1, 2, 5}, {2, 1}), 4 + 8 + 5);
}

TEST(Moments, AreKnownAboutAnyPlace) {
  const Point points[] = {{0, 0}, {1, 0.2}, {0.3, 1}, {-0.8, 0.4}, {-0.2, -0.9}, {0.7, -0.6}, {2, 1}};
  const Point place{0.4, -0.3};
  const double of_place = quadratic(place), of_origin = quadratic({});
  Moments about_origin, about_place, moved;
  for (const Point p : points) {
    about_origin.add(p, quadratic(p) - of_origin);
    about_place.add(p - place, quadratic(p) - of_place);
  }
  moved.add(about_origin, Point{} - place, of_origin - of_place, 1);
  expect_near(about_place.hessian(0), of_quadratic, 1e-6);
  expect_near(moved.hessian(0), of_quadratic, 1e-6);
  moved.add(about_origin, Point{} - place, of_origin - of_place, 3);
  expect_near(moved.hessian(0), of_quadratic, 1e-6);
}

TEST(Moments, OfPointsThatDoNotTellThemAreSmall) {
  EXPECT_EQ(Moments{}.hessian(0), Hessian{});
  Moments row;  // x^2 along a line: nothing across it
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) row.add({x, 0}, x * x);
  expect_near(row.hessian(0), {2, 0, 0}, 1e-12);
  EXPECT_EQ(row.hessian(10), Hessian{}) << "all of it may be rounding";
}

TEST(CellHessians, AreExactForQuadratics) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    if (pieces.whole.points.size() < 50) return;  // fewer cannot tell
    for (const CellHessian& found :
         cell_hessians(world(), pieces.part, at_nodes(pieces.part, quadratic), ValuesAt::nodes)) {
      expect_near(found.mean, absolute(of_quadratic), 1e-5);
      EXPECT_NEAR(found.largest, largest_eigenvalue(of_quadratic), 1e-5);
    }
  });
}

TEST(CellHessians, OfLinearFieldsAreZero) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    ScaledField linear = at_nodes(pieces.part, [](Point p) { return 0.4 * p.x - 0.6 * p.y; });
    linear.rounding = 0x1p-44;
    for (const CellHessian& found : cell_hessians(world(), pieces.part, linear, ValuesAt::nodes))
      EXPECT_EQ(found.largest, 0);
  });
}

TEST(CellHessians, OfValuesOfCellsAreExactAtCentroids) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    if (pieces.whole.points.size() < 50) return;
    ScaledField field;
    for (const CellShape& shape : cell_shapes(pieces.part)) field.values.push_back(quadratic(shape.centroid));
    for (const CellHessian& found : cell_hessians(world(), pieces.part, field, ValuesAt::cells))
      expect_near(found.mean, absolute(of_quadratic), 1e-5);
  });
}

/// All ranks' hessians of triangles, then of quads.
std::vector<Hessian> all_of(const Communicator& comm, const Mesh& mesh, const Function& value) {
  const std::vector<CellHessian> found = cell_hessians(comm, mesh, at_nodes(mesh, value), ValuesAt::nodes);
  std::vector<Hessian> triangles, quads;
  for (std::size_t i = 0; i < found.size(); ++i)
    (i < mesh.triangles.size() ? triangles : quads).push_back(found[i].mean);
  std::vector<Hessian> all = test::joined(comm, triangles);
  const std::vector<Hessian> rest = test::joined(comm, quads);
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

TEST(CellHessians, HaveTheSameBitsOnAnyNumberOfRanks) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const auto value = [](Point p) { return std::sin(7 * p.x) * std::cos(5 * p.y) + 0.3 * p.x; };
    EXPECT_EQ(all_of(world(), pieces.part, value), all_of(Communicator(MPI_COMM_SELF), pieces.whole, value));
  });
}

/// Rows of quads, those of the first `layers` on the floor thinner by `flat`.
Mesh layered_grid(std::int32_t n, std::int32_t layers, double flat) {
  Mesh mesh;
  for (std::int32_t row = 0; row <= n; ++row) {
    const double y = row <= layers ? flat * row : flat * layers + (row - layers) * 0.1;
    for (std::int32_t column = 0; column <= n; ++column) mesh.points.push_back({0.1 * column, y});
  }
  mesh.owned_nodes = size32(mesh.points);
  BoundaryEdges floor{"floor", "wall", {}, {layers, flat * layers}};
  BoundaryEdges rest{"rest", "none", {}, {}};
  const auto node = [&](std::int32_t column, std::int32_t row) { return NodeId{row * (n + 1) + column}; };
  for (std::int32_t k = 0; k < n; ++k) {
    floor.edges.push_back({node(k, 0), node(k + 1, 0)});
    rest.edges.push_back({node(n, k), node(n, k + 1)});
    rest.edges.push_back({node(n - k, n), node(n - k - 1, n)});
    rest.edges.push_back({node(0, n - k), node(0, n - k - 1)});
    for (std::int32_t row = 0; row < n; ++row)
      mesh.quads.push_back({node(k, row), node(k + 1, row), node(k + 1, row + 1), node(k, row + 1)});
  }
  mesh.boundaries = {floor, rest};
  return mesh;
}

TEST(CellHessians, InLayersAreThoseAlongTheRows) {
  constexpr std::int32_t layers = 3;
  const Mesh whole = layered_grid(10, layers, 1e-4);
  const Mesh part = test::Pieces(whole, own_order(whole)).part;
  const double top = 1e-4 * layers;
  // Steep in the layers, and bent along the wall: outside there is x^2 + 2 y^2.
  const auto value = [&](Point p) {
    const double outside = p.x * p.x + 2 * p.y * p.y;
    return p.y < 0.99 * top ? outside + 1e6 * (top - p.y) * (top - p.y) : outside;
  };
  const std::vector<CellHessian> found = cell_hessians(world(), part, at_nodes(part, value), ValuesAt::nodes);
  std::int64_t inner = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& quad = part.quads[i];
    double low = 1, left = 1, right = 0;
    for (const NodeId node : quad) {
      low = std::min(low, part.point(node).y);
      left = std::min(left, part.point(node).x);
      right = std::max(right, part.point(node).x);
    }
    if (low > 0.99 * top) {
      expect_near(found[i].mean, {2, 0, 4}, 1e-4);
    } else if (left > 0.05 && right < 0.95) {
      expect_near(found[i].mean, {2, 0, 0}, 1e-6);
      ++inner;
    }
  }
  EXPECT_EQ(world().sum(inner), 8 * layers);
}

}  // namespace
}  // namespace quadloop::adapt
