// The histograms of shapes that are shown before and after smoothing.
#include "smoother/shape_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

Mesh mesh_of(const std::vector<Point>& points) {
  Mesh mesh;
  mesh.points = points;
  mesh.owned_nodes = static_cast<std::int32_t>(points.size());
  return mesh;
}

/// Of this rank's mesh alone.
std::vector<Histogram> histograms_of(const Mesh& mesh) {
  const Communicator self(MPI_COMM_SELF);
  return shape_histograms(self, mesh);
}

/// How many values lie at `value`, and in all.
std::pair<std::int64_t, std::int64_t> found(const Histogram& histogram, double value) {
  Histogram one = histogram;
  one.counts.assign(one.limits.size() + 1, 0);
  one.add(value);
  std::int64_t at = 0, all = 0;
  for (std::size_t i = 0; i < one.counts.size(); ++i) {
    all += histogram.counts[i];
    if (one.counts[i] != 0) at = histogram.counts[i];
  }
  return {at, all};
}

using Found = std::pair<std::int64_t, std::int64_t>;

TEST(Histogram, CountsFromLimitToLimit) {
  Histogram histogram{"", {1, 2}, {0, 0, 0}};
  for (const double value : {0.5, 1.0, 1.5, 1.9, 2.0, 7.0, 8.0}) histogram.add(value);
  EXPECT_EQ(histogram.counts, (std::vector<std::int64_t>{1, 3, 3}));
}

TEST(ShapeHistograms, OfARhombus) {
  const double angle = 70 * std::acos(-1.0) / 180;
  const Point up{3 * std::cos(angle), 3 * std::sin(angle)};
  Mesh mesh = mesh_of({{0, 0}, {3, 0}, Point{3, 0} + up, up});
  mesh.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  const auto histograms = histograms_of(mesh);
  ASSERT_EQ(histograms.size(), 4U);
  EXPECT_EQ(found(histograms[0], 70), Found(2, 4));
  EXPECT_EQ(found(histograms[0], 110), Found(2, 4));
  EXPECT_EQ(found(histograms[1], 1), Found(1, 1));
  EXPECT_EQ(found(histograms[2], 20.0 / 90), Found(1, 1));
  EXPECT_EQ(found(histograms[3], 1 / std::sin(angle)), Found(1, 1));
}

TEST(ShapeHistograms, OfATriangleWithSidesOf5And6And7) {
  const double x = 38.0 / 14, y = std::sqrt(25 - x * x);
  Mesh mesh = mesh_of({{10, 20}, {17, 20}, {10 + x, 20 + y}});
  mesh.triangles = {{NodeId{0}, NodeId{1}, NodeId{2}}};
  const auto histograms = histograms_of(mesh);
  for (const double degrees : {57.1, 44.4, 78.5}) EXPECT_EQ(found(histograms[0], degrees), Found(1, 3));
  EXPECT_EQ(found(histograms[1], 7.0 / 5), Found(1, 1));
  EXPECT_EQ(found(histograms[2], (60 - 44.4) / 60), Found(1, 1));
  EXPECT_EQ(found(histograms[3], 110 / (4 * std::sqrt(3) * 3.5 * y)), Found(1, 1));
}

TEST(ShapeHistograms, AnInvertedCellHasTheWorstConditionAndAFlatTriangleTheWorstSkewness) {
  Mesh mesh = mesh_of({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {1, 1e-9}, {2, 0}});
  mesh.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  mesh.triangles = {{NodeId{0}, NodeId{5}, NodeId{4}}};
  const auto histograms = histograms_of(mesh);
  EXPECT_EQ(found(histograms[3], 1e300), Found(2, 2));
  EXPECT_EQ(found(histograms[2], 0.999999), Found(1, 2));
  EXPECT_EQ(found(histograms[0], 179.99), Found(1, 7));
}

TEST(ShapeHistograms, CountEveryCellOfAllRanksOnce) {
  const test::Grid grid{7, {1, 1}, true};
  Mesh whole = grid.mesh();
  jitter(grid, 0.2, 11, whole);
  const Communicator self(MPI_COMM_SELF);
  const auto together =
      shape_histograms(test::world(), scatter_mesh(test::world(), whole, space_filling_order(whole)));
  const auto alone = shape_histograms(self, whole);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < together.size(); ++i) EXPECT_EQ(together[i].counts, alone[i].counts);
}

}  // namespace
}  // namespace quadloop::smoother
