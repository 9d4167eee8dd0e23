// Target matrices of cells from a metric: what the metric asks of a cell's own shape, bounded.
#include "adapt/r_adaptation/cell_targets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "smoother/smooth_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::Grid;

std::vector<LogMetric> everywhere(const Mesh& mesh, const Metric& metric) {
  return std::vector<LogMetric>(mesh.points.size(), log_of(metric));
}

/// The largest cost of any cell by its target.
double largest_cost(const Mesh& mesh, const std::vector<smoother::CellTarget>& targets) {
  double worst = 0;
  std::size_t number = 0;
  const auto points_of = [&](const auto& nodes) {
    std::array<Point, std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>>> points;
    for (std::size_t k = 0; k < nodes.size(); ++k) points[k] = mesh.point(nodes[k]);
    return points;
  };
  const auto add = [&](const auto& nodes) {
    constexpr std::size_t width = std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>>;
    const smoother::CellTarget& t = targets[number++];
    worst = std::max(
        worst, smoother::cell_cost<width>(points_of(nodes), smoother::stretched_targets<width>(t.w1, t.w2)));
  };
  for (const auto& nodes : mesh.triangles) add(nodes);
  for (const auto& nodes : mesh.quads) add(nodes);
  return worst;
}

TEST(ShapesOfTree, AskNothingWhereTheMetricAsksForNoSmallerCells) {
  for (const bool quads : {true, false}) {
    const Mesh mesh = Grid{8, {1, 1}, quads}.mesh();
    const ShapesOfTree shapes(mesh);
    EXPECT_LT(largest_cost(mesh, shapes.targets(mesh, everywhere(mesh, isotropic(0.2)), 8)), 1e-24);
    EXPECT_LT(largest_cost(mesh, shapes.targets(mesh, everywhere(mesh, isotropic(0.03)), 8)), 1e-24)
        << "shapes know no size";
  }
}

TEST(ShapesOfTree, GetThinnerAlongTheMetricsAxis) {
  const Mesh mesh = Grid{8, {1, 1}, true}.mesh();  // quads of 1/8, and halves of some
  const ShapesOfTree shapes(mesh);
  const Point across{0.6, 0.8}, along{-0.8, 0.6};
  const Metric metric{symmetric_of({1 / (0.05 * 0.05), 1, across})};
  for (const auto& [stretch, share] : {std::pair{8.0, 0.4}, std::pair{2.0, 0.5}}) {
    const std::vector<smoother::CellTarget> targets = shapes.targets(mesh, everywhere(mesh, metric), stretch);
    ASSERT_EQ(targets.size(), mesh.triangles.size() + mesh.quads.size());
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      const auto& nodes = mesh.quads[i];
      const Point edge = mesh.point(nodes[1]) - mesh.point(nodes[0]);
      const Point wanted = targets[mesh.triangles.size() + i].w1;
      EXPECT_NEAR(dot(wanted, across), share * dot(edge, across), 1e-12);
      EXPECT_NEAR(dot(wanted, along), dot(edge, along), 1e-12);
    }
  }
}

/// Thin across the line x + 0.4 y = 0.7.
std::vector<LogMetric> front_metric(const Mesh& mesh) {
  std::vector<LogMetric> metrics;
  const double size = std::hypot(1, 0.4);
  for (const Point p : mesh.points) {
    const double far = std::abs(p.x + 0.4 * p.y - 0.7) / size, thin = 0.01 + 0.25 * far;
    metrics.push_back(log_of(Metric{symmetric_of({1 / (thin * thin), 1, {1 / size, 0.4 / size}})}));
  }
  return metrics;
}

TEST(ShapesOfTree, MakeTheSmootherLowerTheirCostAndKeepCellsValid) {
  if (!test::world().is_root()) return;
  const Communicator self(MPI_COMM_SELF);
  for (const bool quads : {true, false}) {
    Mesh mesh = Grid{16, {1, 1}, quads}.mesh();
    const ShapesOfTree shapes(mesh);
    smoother::SmoothOptions options;
    options.threshold = 1e-4;
    options.targets = shapes.targets(mesh, front_metric(mesh), 8);
    const smoother::SmoothReport report = smoother::smooth_mesh(self, mesh, options);
    EXPECT_GT(report.moves, 100);
    EXPECT_LT(report.worst_cost_after, 0.8 * report.worst_cost_before);
    EXPECT_EQ(report.inverted_after, 0);
    EXPECT_EQ(largest_cost(mesh, options.targets), report.worst_cost_after);
  }
}

}  // namespace
}  // namespace quadloop::adapt
