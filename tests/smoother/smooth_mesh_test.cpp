// Whole meshes: the same positions on any number of ranks, never worse from sweep to sweep, the boundary
// kept, tangles undone.
#include "smoother/smooth_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "smoother/objective/condition_number.hpp"
#include "tests/smoother/rounding.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::circle;
using test::degrees_rounding;
using test::disc;
using test::expect_same_positions;
using test::expect_same_report;
using test::Grid;
using test::jittered;
using test::rounding;
using test::self;
using test::smooth_both_ways;
using test::Smoothed;
using test::smoothed_alone;
using test::tangled;
using test::world;

TEST(SmoothMesh, IsTheSameOnAnyNumberOfRanks) {
  for (const Method method : {Method::perturb, Method::nlopt}) {
    for (const Objective objective : {Objective::power, Objective::thesis}) {
      SmoothOptions options;
      options.method = method;
      options.objective = objective;
      options.sweeps = 6;
      expect_same_positions(jittered(Grid{12, {3, 1}}, 0.24), [&](const Mesh&) { return options; });
    }
  }
}

TEST(SmoothMesh, IsTheSameOnAnyNumberOfRanksWhereLittleIsBad) {
  const Grid grid{16};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Mesh mesh = jittered(grid, 0.08, seed);
    const std::size_t displaced = 17 * (3 + seed) + 8;
    mesh.points[displaced] = mesh.points[displaced] + Point{0.03, 0.03};
    SmoothOptions options;
    options.threshold = seed % 2 == 0 ? 0.05 : 0.1;
    expect_same_positions(mesh, [&](const Mesh&) { return options; });
  }
}

TEST(SmoothMesh, IsTheSameOnAnyNumberOfRanksFromATangle) {
  expect_same_positions(tangled(Grid{12}, 2), [](const Mesh&) { return SmoothOptions{}; });
}

TEST(SmoothMesh, IsTheSameOnAnyNumberOfRanksAlongAnOutline) {
  const Geometry polygon = circle(240);
  SmoothOptions options;
  options.geometry = &polygon;
  expect_same_positions(disc(Grid{10}, polygon), [&](const Mesh&) { return options; });
}

/// With one round of sweeps alone: fewer sweeps in each of several are not the beginning of more.
void expect_never_worse(const Mesh& mesh, SmoothOptions options) {
  double worst = 1, sharpest = summarise_quality(self(), mesh).smallest_degrees;
  EXPECT_GE(summarise_quality(self(), smoothed_alone(mesh, options)).smallest_degrees,
            sharpest - degrees_rounding);
  options.bad = 1;
  for (options.sweeps = 1; options.sweeps <= 8; ++options.sweeps) {
    SmoothReport report;
    const Mesh after = smoothed_alone(mesh, options, &report);
    const double smallest = summarise_quality(self(), after).smallest_degrees;
    EXPECT_LE(report.worst_cost_after, std::min(worst, report.worst_cost_before) + rounding)
        << options.sweeps << " sweeps";
    EXPECT_GE(smallest, sharpest - degrees_rounding) << options.sweeps << " sweeps";
    worst = report.worst_cost_after;
    sharpest = smallest;
  }
}

TEST(SmoothMesh, NeverGetsWorseFromSweepToSweep) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    for (const Method method : {Method::perturb, Method::nlopt}) {
      SmoothOptions options;
      options.method = method;
      expect_never_worse(jittered(Grid{10, {2, 1}}, 0.24, seed), options);
    }
  }
  const Geometry polygon = circle(240);
  SmoothOptions options;
  options.geometry = &polygon;
  expect_never_worse(disc(Grid{10}, polygon), options);
}

/// In any unit that is a power of two the same bits, but for the exponent: also where squares of lengths, or
/// their products, leave the range of doubles.
TEST(SmoothMesh, LengthsMayBeOfAnySize) {
  const Geometry polygon = circle(240);
  const Mesh tangle = tangled(Grid{10}, 2), disc_mesh = disc(Grid{10}, polygon);
  SmoothOptions options, along = options;
  along.geometry = &polygon;
  const Mesh wanted = smoothed_alone(tangle, options), wanted_disc = smoothed_alone(disc_mesh, along);
  for (const int exponent : {-900, -500, -260, 100, 260, 500, 900}) {
    const auto scaled = [&](Point p) { return Point{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)}; };
    const auto scaled_mesh = [&](Mesh mesh) {
      std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(), scaled);
      return mesh;
    };
    std::vector<Point> vertices(polygon.points().begin(), polygon.points().end());
    std::transform(vertices.begin(), vertices.end(), vertices.begin(), scaled);
    const Geometry scaled_polygon({polygon.boundaries()[0]}, vertices, {0, 240},
                                  std::vector<BoundaryId>(240, BoundaryId{0}));
    along.geometry = &scaled_polygon;
    SmoothReport report;
    EXPECT_TRUE(smoothed_alone(scaled_mesh(tangle), options, &report).points == scaled_mesh(wanted).points)
        << exponent;
    EXPECT_EQ(report.inverted_after, 0) << exponent;
    EXPECT_TRUE(smoothed_alone(scaled_mesh(disc_mesh), along).points == scaled_mesh(wanted_disc).points)
        << exponent;
  }
}

TEST(SmoothMesh, BettersTheWorstCellAndTheSmallestAngle) {
  const Mesh before = jittered(Grid{12}, 0.24);
  SmoothReport report;
  const Mesh after = smoothed_alone(before, {}, &report);
  EXPECT_LT(report.worst_cost_after, 0.5 * report.worst_cost_before);
  EXPECT_GT(summarise_quality(self(), after).smallest_degrees,
            summarise_quality(self(), before).smallest_degrees + 5);
  EXPECT_TRUE(validate(after).empty());
}

TEST(SmoothMesh, ReportsTheWorstCells) {
  const Mesh before = tangled(Grid{12}, 4);
  SmoothReport report;
  SmoothOptions options;
  options.sweeps = 1;
  const Mesh after = smoothed_alone(before, options, &report);
  const auto survey = [](const Mesh& mesh) {
    std::pair<double, std::int64_t> found{0, 0};
    const auto include = [&](double cost) {
      found.first = std::max(found.first, cost);
      found.second += cost >= 1 ? 1 : 0;
    };
    for (const auto& t : mesh.triangles)
      include(cell_cost<3>({mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])}, ideal_targets<3>()));
    for (const auto& q : mesh.quads) {
      include(cell_cost<4>({mesh.point(q[0]), mesh.point(q[1]), mesh.point(q[2]), mesh.point(q[3])},
                           ideal_targets<4>()));
    }
    return found;
  };
  EXPECT_GT(report.inverted_before, 0);
  EXPECT_EQ(survey(before), std::pair(report.worst_cost_before, report.inverted_before));
  EXPECT_EQ(survey(after), std::pair(report.worst_cost_after, report.inverted_after));
}

TEST(SmoothMesh, LeavesAPerfectMeshAlone) {
  Mesh mesh = Grid{8}.mesh();
  mesh.triangles.clear();  // quads alone, all of them
  mesh.quads.clear();
  const auto at = [](std::int32_t i, std::int32_t j) { return NodeId{9 * j + i}; };
  for (std::int32_t j = 0; j < 8; ++j) {
    for (std::int32_t i = 0; i < 8; ++i)
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  SmoothReport report;
  SmoothOptions options;
  options.threshold = 0;
  EXPECT_TRUE(smoothed_alone(mesh, options, &report).points == mesh.points);
  EXPECT_EQ(report.moves, 0);
}

TEST(SmoothMesh, CellsUpToTheThresholdStay) {
  const Mesh mesh = jittered(Grid{10}, 0.1);
  SmoothOptions options;
  options.threshold = 0.9;
  EXPECT_TRUE(smoothed_alone(mesh, options).points == mesh.points);
  options.threshold = 0.01;
  EXPECT_FALSE(smoothed_alone(mesh, options).points == mesh.points);
}

TEST(SmoothMesh, PinnedNodesStay) {
  const Mesh mesh = tangled(Grid{12}, 3);
  const MeshOrder order = space_filling_order(mesh);
  Mesh part = scatter_mesh(world(), mesh, order);
  const Mesh before = part;
  SmoothOptions options;
  for (std::int32_t node = 0; node < part.owned_nodes; ++node)
    options.pinned.push_back((part.first_node + node) % 3 == 0 ? 1 : 0);
  smooth_mesh(world(), part, options);
  std::int64_t moved = 0;
  for (std::int32_t node = 0; node < size32(part.points); ++node) {
    const bool pinned = part.global(NodeId{node}).value() % 3 == 0;
    EXPECT_TRUE(!pinned || part.point(NodeId{node}) == before.point(NodeId{node})) << node;
    moved += part.point(NodeId{node}) != before.point(NodeId{node}) ? 1 : 0;
  }
  EXPECT_GT(world().sum(moved), 10);
}

TEST(SmoothMesh, BoundaryNodesSlideAlongStraightSides) {
  const Grid grid{12, {2, 1}};
  const Mesh before = jittered(grid, 0.24), after = smoothed_alone(before, {});
  int slid = 0;
  for (std::int32_t node = 0; node < before.owned_nodes; ++node) {
    if (grid.inner(node)) continue;
    const Point old = before.point(NodeId{node}), now = after.point(NodeId{node});
    const bool in_row = old.y == 0 || old.y == 1, in_column = old.x == 0 || old.x == 2;
    EXPECT_NEAR(now.y, in_row ? old.y : now.y, rounding);
    EXPECT_NEAR(now.x, in_column ? old.x : now.x, rounding);
    slid += now != old ? 1 : 0;
  }
  EXPECT_GT(slid, 10);
  EXPECT_TRUE(validate(after).empty());
}

TEST(SmoothMesh, CornersStayAlsoWhereBoundariesMeetOnAStraightSide) {
  const Grid grid{8};
  Mesh mesh = jittered(grid, 0.24);
  auto& wall = mesh.boundaries[0].edges;  // the edges of node 4, in the middle of the south side
  const auto leaving =
      std::find_if(wall.begin(), wall.end(), [](const auto& e) { return e[0] == NodeId{4}; });
  BoundaryEdges inflow{"inflow", "inflow", {*leaving}};
  wall.erase(leaving);
  mesh.boundaries.push_back(std::move(inflow));
  const Mesh after = smoothed_alone(mesh, {});
  for (const std::int32_t node : {0, 8, 72, 80, 4, 5})
    EXPECT_EQ(after.point(NodeId{node}), mesh.point(NodeId{node})) << node;
}

double distance_to(const Geometry& polygon, Point p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int32_t s = 0; s < polygon.size(); ++s) {
    const Point a = polygon.point(s), ab = polygon.point(polygon.next(s)) - a;
    const double share = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
    nearest = std::min(nearest, length(p - a - share * ab));
  }
  return nearest;
}

TEST(SmoothMesh, BoundaryNodesStayOnTheOutline) {
  const Grid grid{10};
  const Geometry polygon = circle(240);
  const Mesh before = disc(grid, polygon);
  SmoothOptions options;
  options.geometry = &polygon;
  SmoothReport report;
  const Mesh after = smoothed_alone(before, options, &report);
  int slid = 0;
  for (std::int32_t node = 0; node < before.owned_nodes; ++node) {
    if (grid.inner(node)) continue;
    EXPECT_LE(distance_to(polygon, after.point(NodeId{node})), rounding);
    slid += after.point(NodeId{node}) != before.point(NodeId{node}) ? 1 : 0;
  }
  EXPECT_GT(slid, 20);
  EXPECT_LT(report.worst_cost_after, report.worst_cost_before);
  EXPECT_TRUE(validate(after).empty());
}

/// The unit square, its corners none that must be kept, and a grid on it.
Geometry soft_square() {
  std::vector<Boundary> boundaries(1);
  boundaries[0].name = "square";
  boundaries[0].corner_degrees = 180;
  return {boundaries, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 4}, std::vector<BoundaryId>(4, BoundaryId{0})};
}
Mesh on_soft_square(const Grid& grid, std::uint64_t seed) {
  Mesh mesh = jittered(grid, 0.24, seed);
  auto& boundaries = mesh.boundaries;
  boundaries[0].name = "square";
  boundaries[0].edges.insert(boundaries[0].edges.end(), boundaries[1].edges.begin(),
                             boundaries[1].edges.end());
  boundaries.pop_back();
  return mesh;
}

/// How far a point lies from the nearest boundary edge, as a share of the longest one.
double share_off_boundary(const Mesh& mesh, Point p) {
  double nearest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& [from, to] : mesh.boundaries[0].edges) {
    const Point a = mesh.point(from), ab = mesh.point(to) - a;
    nearest = std::min(nearest, length(p - a - std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) * ab));
    longest = std::max(longest, length(ab));
  }
  return nearest / longest;
}

TEST(SmoothMesh, ChordsStayNearTheOutline) {
  const Geometry square = soft_square();
  SmoothOptions options;
  options.geometry = &square;
  double farthest = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Mesh after = smoothed_alone(on_soft_square(Grid{6, {1, 1}, false}, seed), options);
    for (const Point corner : square.points())
      farthest = std::max(farthest, share_off_boundary(after, corner));
  }
  EXPECT_GT(farthest, 0) << "no node has left a corner";
  EXPECT_LE(farthest, 0.15);
}

/// The shapes of the undisturbed grid's cells.
std::vector<CellTarget> targets_of(const Grid& grid, const Mesh& mesh) {
  std::vector<CellTarget> targets;
  const auto add = [&](NodeId first, NodeId second, NodeId last) {
    const Point p = grid.place(first.value());
    targets.push_back({grid.place(second.value()) - p, grid.place(last.value()) - p});
  };
  for (const auto& t : mesh.triangles) add(t[0], t[1], t[2]);
  for (const auto& q : mesh.quads) add(q[0], q[1], q[3]);
  return targets;
}

double cost_by(const std::vector<CellTarget>& targets, const Mesh& mesh) {
  double sum = 0;
  std::size_t number = 0;
  for (const auto& t : mesh.triangles) {
    const CellTarget& target = targets[number++];
    sum += cell_cost<3>({mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])},
                        stretched_targets<3>(target.w1, target.w2));
  }
  for (const auto& q : mesh.quads) {
    const CellTarget& target = targets[number++];
    sum += cell_cost<4>({mesh.point(q[0]), mesh.point(q[1]), mesh.point(q[2]), mesh.point(q[3])},
                        stretched_targets<4>(target.w1, target.w2));
  }
  return sum;
}

TEST(SmoothMesh, CellsTakeTheShapesTheyAreAskedFor) {
  const Grid grid{10, {2, 1}};
  const Mesh before = jittered(grid, 0.24);
  SmoothOptions options;
  options.targets = targets_of(grid, before);
  options.threshold = 0.002;
  const double asked = cost_by(options.targets, smoothed_alone(before, options));
  EXPECT_LT(asked, 0.1 * cost_by(options.targets, before));
  SmoothOptions ideal;
  ideal.threshold = options.threshold;
  EXPECT_GT(cost_by(options.targets, smoothed_alone(before, ideal)), 2 * asked);
  EXPECT_TRUE(smoothed_alone(grid.mesh(), options).points == grid.mesh().points)
      << "cells that have their shapes already";
}

/// Returns the number of moves.
std::int64_t expect_same_with_targets(const Grid& grid) {
  const Mesh mesh = jittered(grid, 0.24);
  const auto all = targets_of(grid, mesh);
  const MeshOrder order = space_filling_order(mesh);
  const auto options_for = [&](const Mesh& part) {
    const Communicator& comm = part.owned_nodes == mesh.owned_nodes ? self() : world();
    SmoothOptions options;
    const auto take = [&](std::size_t count, const std::vector<std::int32_t>& cells, std::size_t offset) {
      const std::size_t first = comm.exclusive_sum(static_cast<std::int64_t>(count));
      for (std::size_t c = first; c < first + count; ++c)
        options.targets.push_back(all[offset + static_cast<std::size_t>(cells[c])]);
    };
    take(part.triangles.size(), order.triangles, 0);
    take(part.quads.size(), order.quads, mesh.triangles.size());
    return options;
  };
  const Smoothed s = smooth_both_ways(mesh, order, options_for);
  expect_same_report(s.report, s.alone_report);
  for (std::int32_t node = 0; node < size32(s.part.points); ++node) {
    EXPECT_EQ(s.part.point(NodeId{node}), s.alone.points[s.part.global(NodeId{node}).value()]);
  }
  return s.report.moves;
}

TEST(SmoothMesh, IsTheSameOnAnyNumberOfRanksWithTargets) {
  EXPECT_GT(expect_same_with_targets(Grid{10, {2, 1}}), 0);
  expect_same_with_targets(Grid{1, {2, 1}});  // of five ranks some have no cell
}

/// The seeds are shared out among the ranks.
void expect_untangled(Method method, Objective objective = Objective::power) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    if (static_cast<int>(seed) % world().size() != world().rank()) continue;
    const Mesh before = tangled(Grid{20}, seed);
    SmoothOptions options;
    options.method = method;
    options.objective = objective;
    SmoothReport report;
    const Mesh after = smoothed_alone(before, options, &report);
    EXPECT_GT(report.inverted_before, 0) << "seed " << seed;
    EXPECT_EQ(report.inverted_after, 0) << "seed " << seed << ", of " << report.inverted_before
                                        << "; largest cost " << report.worst_cost_after;
    for (const MeshFault& fault : validate(after)) {
      ADD_FAILURE() << "seed " << seed << ": " << name_of(fault.rule) << ": " << fault.what << " at "
                    << fault.place.x << " " << fault.place.y;
    }
  }
}

TEST(SmoothMesh, UntanglesWithPerturbations) { expect_untangled(Method::perturb); }
TEST(SmoothMesh, UntanglesWithNlopt) { expect_untangled(Method::nlopt); }
TEST(SmoothMesh, UntanglesByTheThesissObjective) { expect_untangled(Method::perturb, Objective::thesis); }

}  // namespace
}  // namespace quadloop::smoother
