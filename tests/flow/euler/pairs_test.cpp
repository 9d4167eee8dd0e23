// Flows through periodic pairs: what leaves on one side enters on the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "flow/euler/solve_euler.hpp"
#include "flow/euler/vortex.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/turn.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

/// An irregular grid on a square, its sides "south", "east", "north" and "west" straight, with equal nodes on
/// opposite sides.
Mesh square(std::int32_t n, double side) {
  Mesh mesh = test::irregular_grid(n, {side, side}, 0.15);
  for (std::int32_t i = 0; i <= n; ++i) {
    const auto at = [&](std::int32_t column, std::int32_t row) -> Point& {
      return mesh.points[row * (n + 1) + column];
    };
    at(i, n) = {at(i, 0).x, side};
    at(n, i) = {side, at(0, i).y};
  }
  const double edge = 0.25 * side / n;
  test::relabel(mesh, [&](Point p) {
    return p.y < edge ? "south" : p.y > side - edge ? "north" : p.x < edge ? "west" : "east";
  });
  return mesh;
}

/// The square with pairs in both directions.
Mesh torus(std::int32_t n, double side) {
  Mesh mesh = square(n, side);
  mesh.pairs = {{"west", "east", {side, 0}}, {"south", "north", {0, side}}};
  return mesh;
}

/// Half of a ring, from the radius 1 to 2: `along` the positive x axis, turned by 180 degrees onto `back`.
Mesh half_ring(std::int32_t n) {
  Mesh mesh = square(n, 1);
  for (Point& p : mesh.points) {
    const double angle = std::numbers::pi * p.y, radius = 1 + p.x;
    p = p.y == 1 ? Point{-radius, 0} : Point{radius * std::cos(angle), radius * std::sin(angle)};
  }
  mesh.pairs = {{"south", "north", {}, 180, {}}};
  return mesh;
}

Mesh part_of(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

EulerOptions in_time(double mach, double alpha, double end) {
  EulerOptions options;
  options.mach = mach;
  options.alpha = alpha;
  options.time = EulerOptions::Time::accurate;
  options.end_time = end;
  return options;
}

/// Largest difference of any variable from the first row.
double unevenness(const Field& flow) {
  double largest = 0;
  for (std::size_t i = 0; i < flow.values.size(); ++i)
    largest = std::max(largest, std::abs(flow.values[i] - flow.values[i % flow.width()]));
  return world().maximum(largest);
}

TEST(Pairs, AUniformFlowStaysUniform) {
  const Mesh mesh = part_of(torus(9, 1));
  for (const double viscosity : {0.0, 1e-2}) {
    EulerOptions options = in_time(0.6, 20, 0.3);
    options.viscosity = viscosity;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
    options.time_step = 0.05;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
    options.time_step = {};
    options.time = EulerOptions::Time::steady;
    options.iterations = 5;
    EXPECT_LT(unevenness(solve_euler(world(), mesh, options).flow), 1e-13);
  }
}

/// Joins images of a mesh where they touch to one mesh without pairs. Edges of pairs that lie on its outside
/// become a far field.
class Tiling {
 public:
  explicit Tiling(const Mesh& tile) : tile_{tile} {
    whole_.boundaries = tile.boundaries;
    for (BoundaryEdges& boundary : whole_.boundaries) boundary.edges.clear();
  }

  /// Adds an image; returns the node of the whole at each node of the tile.
  std::vector<NodeId> add(const std::function<Point(Point)>& image) {
    std::vector<NodeId> nodes;
    for (const Point p : tile_.points) nodes.push_back(node_at(image(p)));
    const auto placed = [&](auto cell) {
      for (NodeId& node : cell) node = nodes[node.value()];
      return cell;
    };
    for (const auto& cell : tile_.triangles) whole_.triangles.push_back(placed(cell));
    for (const auto& cell : tile_.quads) whole_.quads.push_back(placed(cell));
    for (std::size_t b = 0; b < tile_.boundaries.size(); ++b) {
      for (const auto& edge : tile_.boundaries[b].edges) whole_.boundaries[b].edges.push_back(placed(edge));
    }
    return nodes;
  }
  Mesh whole() {
    std::set<std::array<NodeId, 2>> all;
    for (const BoundaryEdges& boundary : whole_.boundaries)
      all.insert(boundary.edges.begin(), boundary.edges.end());
    BoundaryEdges outside{"outside", BoundaryCondition::farfield, {}};
    for (BoundaryEdges& boundary : whole_.boundaries) {
      const bool of_pair = std::ranges::any_of(tile_.pairs, [&](const PeriodicPair& pair) {
        return boundary.name == pair.from || boundary.name == pair.to;
      });
      if (!of_pair) continue;
      for (const auto& edge : boundary.edges) {
        if (!all.contains({edge[1], edge[0]})) outside.edges.push_back(edge);
      }
      boundary.edges.clear();
    }
    whole_.boundaries.push_back(outside);
    whole_.owned_nodes = size32(whole_.points);
    return whole_;
  }

 private:
  NodeId node_at(Point p) {
    constexpr double rounding = 1e-9;
    const auto key = [&](double x) { return std::llround(x / rounding); };
    const auto [found, is_new] = nodes_.try_emplace({key(p.x), key(p.y)}, NodeId{size32(whole_.points)});
    if (is_new) whole_.points.push_back(p);
    return found->second;
  }

  const Mesh& tile_;
  Mesh whole_;
  std::map<std::array<std::int64_t, 2>, NodeId> nodes_;
};

/// The flow after a run on a mesh that is whole on each rank, in the order of its nodes; on the root only.
Field flow_on(const Mesh& whole, const EulerOptions& options,
              const std::function<euler::State(Point)>& start) {
  const MeshOrder order = test::shuffled_order(whole, 5);
  const Mesh mesh = scatter_mesh(world(), whole, order);
  Field states;
  states.names = {"density", "x_velocity", "y_velocity", "pressure"};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const euler::State state = start(mesh.point(NodeId{node}));
    states.values.insert(states.values.end(), state.begin(), state.end());
  }
  return gather_field(world(), solve_euler(world(), mesh, options, states).flow, mesh, order);
}

constexpr double box_period = 10, vortex_mach = 0.5, vortex_degrees = 45;
constexpr Point before_corner{9.3, 9.3};

/// A vortex that drifts by two units through the corner of a periodic box, exactly.
euler::State drifting_vortex(Point p, double time) {
  const euler::Gas gas;
  const euler::Vortex vortex{gas, gas.free_stream(vortex_mach, vortex_degrees), before_corner, 1};
  const Point centre = before_corner + time * vortex_mach * unit_vector(vortex_degrees);
  const auto nearest = [](double at, double to) {
    return at - box_period * std::round((at - to) / box_period);
  };
  return vortex.state({nearest(p.x, centre.x), nearest(p.y, centre.y)}, time);
}
constexpr double end_of_drift = 2 / vortex_mach;

EulerOptions through_corner() {
  EulerOptions options = in_time(vortex_mach, vortex_degrees, end_of_drift);
  options.limiter = EulerOptions::Limiter::none;
  return options;
}

double square_of(double x) { return x * x; }

/// Root mean square error of the density behind the corner, relative to the vortex: 1 if it is lost.
double error_behind_corner(std::int32_t n) {
  const Mesh whole = torus(n, box_period);
  const Field flow = flow_on(whole, through_corner(), [](Point p) { return drifting_vortex(p, 0); });
  double error = 0, vortex = 0;
  for (const NodeId node : ids_below(NodeId{world().is_root() ? whole.owned_nodes : 0})) {
    const double density = drifting_vortex(whole.point(node), end_of_drift)[0];
    error += square_of(flow.row(node)[0] - density);
    vortex += square_of(1 - density);
  }
  return world().maximum(error > 0 ? std::sqrt(error / vortex) : 0);
}

TEST(Pairs, AVortexPassesThroughTheCornerToSecondOrder) {
  const double coarse = error_behind_corner(24), fine = error_behind_corner(48);
  EXPECT_GE(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

TEST(Pairs, PartnersHaveTheSameState) {
  const std::int32_t n = 12;
  const Mesh whole = torus(n, 10);
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  EulerOptions options = in_time(0.5, 30, 6);
  options.initial = EulerOptions::Initial::vortex;
  options.vortex_centre = Point{9, 9};
  const Field flow = gather_field(world(), solve_euler(world(), mesh, options).flow, mesh, own_order(whole));
  if (!world().is_root()) return;
  const auto row = [&](std::int32_t i, std::int32_t j) { return flow.row(NodeId{j * (n + 1) + i}); };
  EXPECT_FALSE(std::ranges::equal(row(0, 0), row(1, 1)));
  for (std::int32_t i = 0; i <= n; ++i) {
    EXPECT_TRUE(std::ranges::equal(row(i, 0), row(i, n))) << i;
    EXPECT_TRUE(std::ranges::equal(row(0, i), row(n, i))) << i;
  }
}

/// Two runs, on all ranks and alone, must agree to the last bit.
void expect_same_on_all_ranks(const Mesh& whole, const EulerOptions& options) {
  const MeshOrder order = test::shuffled_order(whole, 5);
  const Communicator self(MPI_COMM_SELF);
  const Mesh part = scatter_mesh(world(), whole, order);
  const EulerResult together = solve_euler(world(), part, options),
                    alone = solve_euler(self, scatter_mesh(self, whole, order), options);
  const auto first = alone.flow.values.begin() + static_cast<std::ptrdiff_t>(4 * part.first_node);
  EXPECT_TRUE(std::equal(together.flow.values.begin(), together.flow.values.end(), first));
  EXPECT_EQ(together.residual, alone.residual);
}

TEST(Pairs, RanksGiveTheSameBits) {
  EulerOptions options = in_time(0.5, 30, 1);
  options.initial = EulerOptions::Initial::vortex;
  options.boundaries = {{"west", "wall", {}}, {"east", "wall", {}}};
  for (const Mesh& whole : {torus(9, 5), torus(2, 5), torus(1, 5)}) {
    expect_same_on_all_ranks(whole, options);
    EulerOptions implicit = options;
    implicit.time_step = 0.2;
    expect_same_on_all_ranks(whole, implicit);
  }
  options.mach = 0.2;
  expect_same_on_all_ranks(half_ring(8), options);
  options.time = EulerOptions::Time::steady;
  options.iterations = 12;
  expect_same_on_all_ranks(half_ring(8), options);
  expect_same_on_all_ranks(torus(9, 5), options);
}

EulerOptions between_walls(double mach, double end) {
  EulerOptions options = in_time(mach, 0, end);
  options.boundaries = {{"west", "wall", {}}, {"east", "wall", {}}};
  return options;
}

TEST(Pairs, GasAtRestInHalfARingStaysAtRest) {
  EXPECT_LT(unevenness(solve_euler(world(), part_of(half_ring(8)), between_walls(0, 0.5)).flow), 1e-13);
}

constexpr double swirl_rate = 0.2;

/// A steady flow around the origin: the velocity w r and the pressure p = rho w^2 r^2 / 2 + constant.
euler::State swirling(Point p) {
  return {1, -swirl_rate * p.y, swirl_rate * p.x, 1 / 1.4 + 0.5 * swirl_rate * swirl_rate * (dot(p, p) - 1)};
}

/// Root mean square change of the steady flow after some time: the error of the scheme.
double change_of_swirl(std::int32_t n) {
  const Mesh whole = half_ring(n);
  EulerOptions options = between_walls(0, 0.5);
  options.limiter = EulerOptions::Limiter::none;
  const Field flow = flow_on(whole, options, swirling);
  double sum = 0;
  for (const NodeId node : ids_below(NodeId{world().is_root() ? whole.owned_nodes : 0})) {
    const euler::State exact = swirling(whole.point(node));
    for (std::size_t k = 0; k < 4; ++k) sum += square_of(flow.row(node)[k] - exact[k]);
  }
  return world().maximum(std::sqrt(sum / whole.owned_nodes));
}

TEST(Pairs, VelocitiesTurnWithARotation) {
  const double coarse = change_of_swirl(16), fine = change_of_swirl(32);
  EXPECT_GE(std::log2(coarse / fine), 1.4) << coarse << " " << fine;
}

/// A flow that is not steady and equal after half a turn: the half ring with its pair and the whole ring
/// without one differ by rounding only.
TEST(Pairs, AFlowInHalfARingIsThatInTheWholeRing) {
  const Mesh half = half_ring(12);
  Tiling tiles(half);
  const std::vector<NodeId> first = tiles.add([](Point p) { return p; });
  tiles.add([](Point p) { return -1.0 * p; });
  const auto start = [](Point p) {
    euler::State state = swirling(p);
    state[3] *= 1 + 0.1 * p.x * p.y;
    return state;
  };
  for (const double viscosity : {0.0, 1e-2}) {
    EulerOptions options = between_walls(0, 1);
    options.viscosity = viscosity;
    const Field paired = flow_on(half, options, start), whole = flow_on(tiles.whole(), options, start);
    if (!world().is_root()) continue;
    double largest = 0, change = 0;
    for (const NodeId node : ids_below(NodeId{half.owned_nodes})) {
      for (std::size_t k = 0; k < 4; ++k) {
        largest = std::max(largest, std::abs(paired.row(node)[k] - whole.row(first[node.value()])[k]));
        change = std::max(change, std::abs(paired.row(node)[k] - start(half.point(node))[k]));
      }
    }
    EXPECT_LT(largest, 1e-12);
    EXPECT_GT(change, 0.01);
  }
}

TEST(Pairs, WhatIsNotSupportedIsRefused) {
  const Mesh ring = part_of(half_ring(4)), box = part_of(torus(4, 1));
  EulerOptions options = in_time(0.5, 0, 0.1);
  options.boundaries = {{"west", "farfield", {}}, {"east", "wall", {}}};
  EXPECT_THROW(solve_euler(world(), ring, options), InputError);
  options.mach = 0;
  EXPECT_NO_THROW(solve_euler(world(), ring, options));
  options.far_field = EulerOptions::FarField::vortex;
  EXPECT_THROW(solve_euler(world(), box, options), InputError);
}

}  // namespace
}  // namespace quadloop::flow
