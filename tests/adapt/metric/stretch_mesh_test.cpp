// Meshes adapted to the metric of a solution: unit edges, valid cells, the wanted number of nodes, the true
// outline, cells counted by their leaves; the same mesh on any number of ranks, and less error than equal
// leaves leave.
#include "adapt/metric/stretch_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adapt/metric/gradation.hpp"
#include "adapt/metric/leaf_shares.hpp"
#include "adapt/metric/loose_triangles.hpp"
#include "adapt/metric/metric_statistics.hpp"
#include "adapt/metric/node_bends.hpp"
#include "adapt/metric/target_metric.hpp"
#include "adapt/metric/tiles.hpp"
#include "adapt/metric/unit_mesh.hpp"
#include "adapt/sensor/solver_error.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// A square with a round hole in it.
MeshInput holed_square(double size) {
  std::vector<Point> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<BoundaryId> of_segments(4, BoundaryId{0});
  constexpr int fine = 90;
  for (int i = 0; i < fine; ++i) {
    const double turn = -2 * std::acos(-1.0) * i / fine;
    points.push_back({0.3 * std::cos(turn), 0.3 * std::sin(turn)});
    of_segments.push_back(BoundaryId{1});
  }
  MeshInput input{
      {{{"side", 0, 30, "wall"}, {"hole", size, 30, "wall"}}, points, {0, 4, 4 + fine}, of_segments},
      {},
      {},
      0};
  input.mesh.type = MeshType::metric;
  input.mesh.size.min = input.mesh.size.max = size;
  return input;
}

double front(Point p) { return std::tanh(25 * (p.x + 0.3 * p.y - 0.1)); }

Field front_on(const Mesh& mesh) {
  Field field{{"q"}, {}, {}};
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) field.values.push_back(front(mesh.point(NodeId{n})));
  return field;
}

MetricDemand demand(std::int64_t nodes) {
  MetricDemand wanted{{"q"}, {}, 2, nodes, 1e-3};
  wanted.tile_size = 200;
  return wanted;
}

struct Stretched {
  MeshResult result;
  StretchReport report;
};

/// Each time from the solution on the last mesh.
Stretched stretched(const Communicator& comm, const MeshInput& input, int cycles, std::int64_t nodes) {
  Stretched made;
  Mesh solved = generate_mesh(comm, input).result.mesh;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const MeshChange change = [&](const MeshInput& outer, MeshResult& result) {
      made.report = stretch_mesh(comm, outer, solved, front_on(solved), demand(nodes), result);
    };
    made.result = generate_mesh(comm, input, {}, {}, change).result;
    solved = made.result.mesh;
  }
  return made;
}

/// Sum over cells of area times the error at the middles of edges: about the L1 norm.
double error_of(const Mesh& whole) {
  double sum = 0;
  for (const auto& t : whole.triangles) {
    const Point a = whole.point(t[0]), b = whole.point(t[1]), c = whole.point(t[2]);
    double error = 0;
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      error += std::abs(front(0.5 * (p + q)) - 0.5 * (front(p) + front(q))) / 3;
    sum += 0.5 * cross(b - a, c - a) * error;
  }
  return sum;
}

void expect_counted_by_leaves(const MeshResult& result) {
  std::int64_t cells = 0;
  for (const LeafRecord& leaf : result.tree.leaves) cells += leaf.triangles;
  EXPECT_EQ(cells, std::ssize(result.mesh.triangles)) << "leaves and their cells are on one rank";
  for (std::size_t b = 0; b < result.edge_leaves.size(); ++b) {
    EXPECT_EQ(result.edge_leaves[b].size(), result.mesh.boundaries[b].edges.size());
    EXPECT_TRUE(std::ranges::is_sorted(result.edge_leaves[b]));
  }
}

std::int64_t nodes_of(const Mesh& mesh) { return world().sum(std::int64_t{mesh.owned_nodes}); }

TEST(StretchMesh, TellsHowManyNodesTheCaseTakesAtLeast) {
  const Stretched made = stretched(world(), holed_square(0.25), 1, 60);
  const std::int64_t nodes = nodes_of(made.result.mesh);
  ASSERT_GT(nodes, 60);
  ASSERT_EQ(made.report.warnings.size(), 1U);
  const std::string &told = made.report.warnings[0], words = "set at least ";
  ASSERT_NE(told.find(words), std::string::npos) << told;
  const std::int64_t least = std::stoll(told.substr(told.find(words) + words.size()));
  EXPECT_GT(least, nodes);
  EXPECT_LT(10 * least, 11 * nodes);
  const StretchReport again = stretched(world(), holed_square(0.25), 1, least).report;
  EXPECT_TRUE(again.warnings.empty()) << told << "; then " << again.warnings[0];
}

TEST(StretchMesh, HasNoMoreNodesThanAllowedWhereTheTreesMeshHasNot) {
  const std::int64_t of_tree = nodes_of(generate_mesh(world(), holed_square(0.25)).result.mesh);
  for (std::int64_t allowed = of_tree; allowed < of_tree + 16; allowed += 3) {
    const Stretched made = stretched(world(), holed_square(0.25), 1, allowed);
    EXPECT_LE(nodes_of(made.result.mesh), allowed);
    expect_counted_by_leaves(made.result);
  }
}

/// The share of the edges from 1 / sqrt(2) to sqrt(2).
double unit_share(const MetricStatistics& statistics) {
  const auto all = std::accumulate(statistics.edges.begin(), statistics.edges.end(), std::int64_t{0});
  return static_cast<double>(statistics.edges[2] + statistics.edges[3]) / static_cast<double>(all);
}

TEST(StretchMesh, FollowsTheMetricWithTheNodesWanted) {
  const Stretched made = stretched(world(), holed_square(0.25), 2, 600);
  const std::int64_t nodes = world().sum(std::int64_t{made.result.mesh.owned_nodes});
  EXPECT_LE(nodes, 600);
  EXPECT_GE(nodes, 0.95 * 600);
  EXPECT_TRUE(made.report.warnings.empty());
  EXPECT_GT(unit_share(made.report.statistics), 0.93);
  EXPECT_GT(made.report.statistics.worst_quality, 0.15);
  expect_counted_by_leaves(made.result);
  const Mesh whole = gather_whole(world(), made.result.mesh),
             equal = gather_whole(world(), generate_mesh(world(), holed_square(1.0 / 16)).result.mesh);
  if (!world().is_root()) return;
  EXPECT_GT(equal.points.size(), whole.points.size());
  EXPECT_LT(error_of(whole), 0.2 * error_of(equal));
  const auto faults = validate(whole);
  EXPECT_TRUE(faults.empty()) << faults.front().what;
  std::int64_t on_hole = 0;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    for (const auto& edge : boundary.edges) {
      if (boundary.name != "hole") continue;
      ++on_hole;
      EXPECT_NEAR(length(whole.point(edge[0])), 0.3, 0.3 * 0.002);
    }
  }
  EXPECT_GT(on_hole, 12);
}

TEST(StretchMesh, IsTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Stretched here = stretched(self, holed_square(0.25), 1, 350);
  const Stretched all = stretched(world(), holed_square(0.25), 1, 350);
  const Mesh whole = gather_whole(world(), all.result.mesh), alone = gather_whole(self, here.result.mesh);
  EXPECT_EQ(all.report.statistics.complexity, here.report.statistics.complexity);
  EXPECT_EQ(all.report.statistics.edges, here.report.statistics.edges);
  if (!world().is_root()) return;
  EXPECT_EQ(whole.points, alone.points);
  EXPECT_EQ(whole.triangles, alone.triangles);
  ASSERT_EQ(whole.boundaries.size(), alone.boundaries.size());
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b)
    EXPECT_EQ(whole.boundaries[b].edges, alone.boundaries[b].edges);
}

TEST(LooseTriangles, MakeTheSameMeshAgain) {
  const Mesh mesh = generate_mesh(world(), holed_square(0.125)).result.mesh;
  const Mesh again =
      joined(world(), loosened(world(), mesh, std::vector<LogMetric>(mesh.points.size())), mesh.boundaries);
  const auto edges_of = [](const Mesh& m) {
    std::int64_t edges = 0;
    for (const BoundaryEdges& boundary : m.boundaries) edges += std::ssize(boundary.edges);
    return world().sum(edges);
  };
  EXPECT_EQ(world().sum(std::int64_t{again.owned_nodes}), world().sum(std::int64_t{mesh.owned_nodes}));
  EXPECT_EQ(edges_of(again), edges_of(mesh));
  const Mesh whole = gather_whole(world(), again);
  if (world().is_root()) {
    EXPECT_TRUE(validate(whole).empty());
  }
}

TEST(LooseTriangles, FindTheirBoundaryEdgesOnOtherRanks) {
  const Mesh whole = test::Grid{8, {1, 1}, false}.mesh();
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 7));
  std::int64_t edges = 0;
  for (const LooseTriangle& t : loosened(world(), mesh, std::vector<LogMetric>(mesh.points.size()))) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.boundaries[k] < 0) continue;
      ++edges;
      const Point middle = 0.5 * (t.nodes[k].point + t.nodes[(k + 1) % 3].point);
      EXPECT_TRUE(middle.x == 0 || middle.x == 1 || middle.y == 0 || middle.y == 1);
    }
  }
  EXPECT_EQ(world().sum(edges), 32);
}

TEST(LimitGrowth, KeepsSizesWithinReachOfTheSmallest) {
  const Mesh mesh = generate_mesh(world(), holed_square(0.125)).result.mesh;
  std::vector<Metric> metrics(mesh.points.size(), isotropic(10));
  for (std::size_t n = 0; n < metrics.size(); ++n) {
    if (mesh.points[n] == Point{-1, -1}) metrics[n] = isotropic(0.01);
  }
  limit_growth(world(), mesh, 0.25, metrics);
  for (std::size_t n = 0; n < metrics.size(); ++n) {
    const double size = 1 / std::sqrt(density_of(metrics[n])), way = length(mesh.points[n] - Point{-1, -1});
    EXPECT_LE(size, 1.01 * (0.01 + 0.25 * 2 * way)) << "along edges the way is longer";
    EXPECT_GE(size, 0.99 * (0.01 + 0.25 * way));
  }
}

TEST(TargetMetric, HasTheComplexityAskedFor) {
  const Mesh mesh = generate_mesh(world(), holed_square(0.0625)).result.mesh;
  const SizeBounds bounds{1e-3, std::vector<double>(mesh.points.size(), 0.5), 0.25};
  const auto wanted_of = [&](const Field& field) {
    return TargetMetric(world(), mesh, variable_bends(world(), mesh, field), 2, bounds);
  };
  const TargetMetric wanted = wanted_of(front_on(mesh));
  ASSERT_FALSE(wanted.flat());
  for (const double complexity : {200.0, 2000.0}) {
    const auto metrics = wanted.of_complexity(complexity);
    EXPECT_NEAR(metric_statistics(world(), mesh, metrics).complexity, complexity, 0.021 * complexity);
    for (const LogMetric& m : metrics) EXPECT_LE(eigen_of(exp_of(m)).larger, 1.0001e6) << "the least size";
  }
  Field constant = front_on(mesh);
  std::ranges::fill(constant.values, 3.0);
  EXPECT_TRUE(wanted_of(constant).flat());
}

/// Of cells over which a front rises by more than a fifth of its height: by the moments of their edges.
double median_stretch(const Mesh& whole) {
  std::vector<double> stretches;
  for (const auto& t : whole.triangles) {
    const std::array<Point, 3> p{whole.point(t[0]), whole.point(t[1]), whole.point(t[2])};
    const auto [low, high] = std::minmax({front(p[0]), front(p[1]), front(p[2])});
    if (high - low < 0.4) continue;
    Symmetric moments;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point e = p[(k + 1) % 3] - p[k];
      moments = moments + Symmetric{e.x * e.x, e.x * e.y, e.y * e.y};
    }
    const Eigen2 axes = eigen_of(moments);
    stretches.push_back(std::sqrt(axes.larger / axes.smaller));
  }
  std::ranges::sort(stretches);
  return stretches[stretches.size() / 2];
}

TEST(StretchMesh, KeepsCellsLongAtAFrontWhereTheyMayBeNoThinner) {
  if (!world().is_root()) return;  // the same on any number of ranks
  const Communicator self(MPI_COMM_SELF);
  const MeshInput input = holed_square(0.25);
  Mesh solved = generate_mesh(self, input).result.mesh;
  for (int cycle = 0; cycle < 4; ++cycle) {
    const MeshChange change = [&](const MeshInput& outer, MeshResult& result) {
      stretch_mesh(self, outer, solved, front_on(solved), {{"q"}, {}, 100, 600, 0.02}, result);
    };
    solved = generate_mesh(self, input, {}, {}, change).result.mesh;
  }
  const Mesh whole = gather_whole(self, solved);
  EXPECT_GT(median_stretch(whole), 4);
}

TEST(TargetMetric, KeepsItsShapeWhereCellsMayNotBeThinner) {
  const Mesh mesh = generate_mesh(world(), holed_square(0.25)).result.mesh;
  const std::vector<Symmetric> bends(mesh.points.size(), Symmetric{100, 0, 1});
  const SizeBounds bounds{0.01, std::vector<double>(mesh.points.size(), 1), 0.25};
  const TargetMetric wanted(world(), mesh, bends, 2, bounds);
  for (const LogMetric& m : wanted.of_complexity(1e9)) {
    const Eigen2 axes = eigen_of(exp_of(m));
    EXPECT_NEAR(axes.larger, 1e4, 1e-6 * 1e4);
    EXPECT_NEAR(axes.smaller, 1e2, 1e-6 * 1e2);
  }
}

/// A unit square whose columns become narrower towards x = 0 by equal factors.
Mesh narrowing_mesh(double narrowest) {
  constexpr int columns = 24;
  Mesh whole = test::Grid{columns, {1, 1}, false}.mesh();
  for (Point& p : whole.points) p.x = std::pow(narrowest, 1 - p.x);
  return whole;
}

TEST(VariableBends, AreNoLargerFarAwayBecauseTheyAreLargeSomewhere) {
  constexpr double narrowest = 1e-7;
  const Mesh whole = narrowing_mesh(narrowest);
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  Field field{{"q"}, {}, {}};
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n)
    field.values.push_back(std::log(mesh.point(NodeId{n}).x));
  const std::vector<Symmetric> bends = variable_bends(world(), mesh, field);
  const double range = -std::log(narrowest);
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) {
    const double x = mesh.point(NodeId{n}).x, exact = 1 / (x * x * range);
    EXPECT_GT(eigen_of(bends[n]).larger, exact / 20);
    EXPECT_LT(eigen_of(bends[n]).larger, 20 * exact) << "at x = " << x;
  }
}

TEST(ErrorBends, LoseAsMuchForEachAreaAsTheError) {
  const Mesh whole = test::Grid{16, {1, 1}, false}.mesh();
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 5));
  const std::vector<Symmetric> shapes(mesh.points.size(), Symmetric{9, 0, 1});
  Field error{{"e"}, {}, {}};
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) error.values.push_back(2 * mesh.point(NodeId{n}).x);
  const std::vector<Symmetric> bends = error_bends(world(), mesh, error, shapes);
  const std::vector<double> densities = error_densities(world(), mesh, error);
  constexpr double edge = 1.0 / 16, lost = (9 + 1 + 10) * edge * edge / 24;  // of halves of squares
  for (std::size_t n = 0; n < bends.size(); ++n) {
    if (mesh.points[n].x == 0) continue;  // no error
    EXPECT_NEAR(bends[n].xx / 9 * lost, densities[n], 1e-9 * densities[n]);
    EXPECT_NEAR(bends[n].yy, bends[n].xx / 9, 1e-9 * bends[n].yy);
  }
  error.values.assign(error.values.size(), -1);
  EXPECT_THROW(error_bends(world(), mesh, error, shapes), InputError);
  error.values.assign(error.values.size(), 0);
  EXPECT_TRUE(error_bends(world(), mesh, error, shapes).empty());
}

TEST(MetricStatistics, CountEveryEdgeOnce) {
  const Mesh mesh = generate_mesh(world(), holed_square(0.125)).result.mesh;
  const std::vector<LogMetric> metrics(mesh.points.size(), log_of(isotropic(0.125)));
  const MetricStatistics statistics = metric_statistics(world(), mesh, metrics);
  const auto sum = [](const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  };
  const std::int64_t nodes = world().sum(std::int64_t{mesh.owned_nodes}),
                     triangles = world().sum(std::ssize(mesh.triangles));
  EXPECT_EQ(sum(statistics.triangles), triangles);
  EXPECT_EQ(nodes - sum(statistics.edges) + triangles, 0) << "Euler's number of a ring";
  EXPECT_NEAR(statistics.complexity, (4 - 0.3 * 0.3 * std::acos(-1.0)) / (0.125 * 0.125), 1);
  EXPECT_NE(lines_of(statistics).find("complexity"), std::string::npos);
  EXPECT_NE(record_of(statistics).text().find("\"limits\""), std::string::npos);
}

}  // namespace
}  // namespace quadloop::adapt
