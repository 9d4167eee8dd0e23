// What a chord cuts off shrinks with the square of the spacing at the wall.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

constexpr int vertices = 20000;

/// Clockwise: the domain lies outside.
Chain circle() {
  Chain chain;
  chain.name = "wall";
  for (int i = 0; i < vertices; ++i) {
    const double t = -2 * std::numbers::pi * i / vertices;
    chain.points.push_back({0.013 + 0.5 * std::cos(t), 0.017 + 0.5 * std::sin(t)});
  }
  return chain;
}

/// NACA 0012 with a closed trailing edge; cosine spacing.
Chain naca0012() {
  Chain chain;
  chain.name = "wall";
  for (int i = 0; i < vertices; ++i) {
    const double t = 2 * std::numbers::pi * i / vertices, x = (1 + std::cos(t)) / 2;
    const double y = 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                            0.1036 * x * x * x * x);
    chain.points.push_back({x - 0.487, i == 0 ? 0 : t < std::numbers::pi ? -y : y});
  }
  return chain;
}

double area_within(const Chain& chain) {
  double twice = 0;
  for (std::size_t i = 0; i < chain.points.size(); ++i)
    twice += cross(chain.points[i], chain.points[(i + 1) % chain.points.size()]);
  return twice / 2;
}

/// The error of the mesh's area where leaves at the wall have this size.
double area_error(const Chain& wall, double spacing) {
  Chain box;
  box.name = "box";
  box.points = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  AssembleOptions how;
  BoundaryRule at_wall, at_box;
  at_wall.pattern = "wall";
  at_wall.spacing = spacing;
  at_box.pattern = "box";
  at_box.spacing = 0.25;
  how.rules = {at_wall, at_box};
  Warnings warnings;
  const Geometry geometry = assemble({box, wall}, how, warnings);
  MeshOptions options;
  options.size.min = spacing / 4;
  options.size.max = 0.25;
  options.size.root = RootOptions{{-1, -1}, 2, 1, 1};
  const MeshResult result = build_mesh(test::world(), geometry, options);
  return std::abs(area_of(result.mesh) - (4 + area_within(wall)));
}

/// Least squares of the logarithms.
double order_of(const Chain& wall) {
  double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (int level = 4; level <= 8; ++level) {
    const double spacing = std::ldexp(1.0, -level), x = std::log(spacing),
                 y = std::log(area_error(wall, spacing));
    n += 1;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

TEST(Convergence, AreaRoundACircleIsOfSecondOrder) { EXPECT_NEAR(order_of(circle()), 2, 0.15); }

TEST(Convergence, AreaRoundAnAirfoilIsOfSecondOrder) { EXPECT_GT(order_of(naca0012()), 1.85); }

}  // namespace
}  // namespace quadloop
