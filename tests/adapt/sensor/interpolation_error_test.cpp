// Interpolation errors of cells: those of quadratics, of second order, and the densities that make their norm
// least.
#include "adapt/sensor/interpolation_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::part_of;
using test::world;

/// Mean of |q - its interpolant| over a triangle, for a quadratic x^2 + 3 y^2, by many points.
double mean_error(Point a, Point b, Point c) {
  const auto q = [](Point p) { return p.x * p.x + 3 * p.y * p.y; };
  constexpr int n = 200;
  double sum = 0;
  int count = 0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n - i; ++k) {
      const double u = (i + 1.0 / 3) / n, v = (k + 1.0 / 3) / n, w = 1 - u - v;
      sum += u * q(a) + v * q(b) + w * q(c) - q(u * a + v * b + w * c);
      ++count;
    }
  }
  return sum / count;
}

TEST(InterpolationErrors, AreThoseOfAQuadraticInTriangles) {
  const Mesh mesh = part_of({8, {1, 2}, false});
  const Field field = field_of(mesh, "q", [](std::int64_t, Point p) { return p.x * p.x + 3 * p.y * p.y; });
  const InterpolationError error = interpolation_error(world(), mesh, field);
  const double range = 1 + 3 * 4;
  ASSERT_EQ(error.mean.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < error.mean.size(); ++i) {
    const auto& nodes = mesh.triangles[i];
    const double expected = mean_error(mesh.point(nodes[0]), mesh.point(nodes[1]), mesh.point(nodes[2]));
    EXPECT_NEAR(error.mean[i] * range, expected, 0.02 * expected);
    EXPECT_NEAR(error.bends[i] * range, 6, 1e-5);
    EXPECT_NEAR(error.areas[i], 1.0 / 64, 1e-15);
  }
}

double error_of_front(std::int32_t n, bool quads, double p) {
  const Mesh mesh = part_of({n, {1, 1}, quads});
  const Field front =
      field_of(mesh, "q", [](std::int64_t, Point at) { return std::tanh(6 * (at.x + 0.5 * at.y - 0.7)); });
  return norm_of(world(), interpolation_error(world(), mesh, front), p);
}

TEST(InterpolationErrors, AreOfSecondOrder) {
  for (const double p : {1.0, 2.0, 4.0}) {
    for (const bool quads : {false, true}) {
      const double order = std::log2(error_of_front(32, quads, p) / error_of_front(64, quads, p));
      EXPECT_NEAR(order, 2, 0.1) << p;
    }
  }
}

TEST(InterpolationErrors, CountTheLargestOfSeveralVariables) {
  const Mesh mesh = part_of({8, {1, 1}, true});
  const auto one = field_of(mesh, "a", [](std::int64_t, Point p) { return p.x * p.x; }),
             other = field_of(mesh, "b", [](std::int64_t, Point p) { return 100 * p.y * p.y * p.y; });
  const InterpolationError both = interpolation_error(world(), mesh, test::joined_fields(one, other)),
                           a = interpolation_error(world(), mesh, one),
                           b = interpolation_error(world(), mesh, other);
  for (std::size_t i = 0; i < both.mean.size(); ++i) {
    EXPECT_EQ(both.mean[i], std::max(a.mean[i], b.mean[i]));
    EXPECT_EQ(both.bends[i], std::max(a.bends[i], b.bends[i]));
  }
}

TEST(InterpolationErrors, NeedFiniteValues) {
  const Mesh mesh = part_of({4, {1, 1}, true});
  const auto bad = field_of(mesh, "q", [](std::int64_t node, Point) { return node == 3 ? 1 / 0.0 : 1; });
  EXPECT_THROW(interpolation_error(world(), mesh, bad), InputError);
}

TEST(Densities, FollowTheRule) {
  InterpolationError error;
  error.bends = {0, 1, 16};
  EXPECT_EQ(cell_densities(error, 1), (std::vector<double>{0, 1, 4}));
  EXPECT_NEAR(cell_densities(error, 3)[2], 8, 1e-14);
}

TEST(Densities, MakeTheNormLeast) {
  // Sizes h in cells of area 1: of errors bend * h^2 the p-norm, for a sum of 1 / h^2.
  InterpolationError error;
  error.bends = {0.3, 2, 70, 5};
  const double p = 2, complexity = 1000;
  const std::vector<double> best = cell_densities(error, p);
  double total = 0;
  for (const double density : best) total += density;
  const auto norm = [&](const std::vector<double>& densities) {
    double sum = 0, all = 0;
    for (const double density : densities) all += density;
    for (std::size_t i = 0; i < densities.size(); ++i)
      sum += std::pow(error.bends[i] * all / (complexity * densities[i]), p);
    return std::pow(sum, 1 / p);
  };
  for (std::size_t i = 0; i < best.size(); ++i) {
    for (const double factor : {0.9, 1.1}) {
      std::vector<double> other = best;
      other[i] *= factor;
      EXPECT_LT(norm(best), norm(other));
    }
  }
}

}  // namespace
}  // namespace quadloop::adapt
