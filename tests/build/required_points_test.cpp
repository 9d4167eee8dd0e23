// Single points that must be nodes: exact, without refinement, in sound meshes that are the same on any
// number of ranks; refused where there is no room for a node.
#include "mesher/build/required_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/build/sound_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// The unit square around a circle of radius 0.15 at its centre.
Geometry square_with_circle() {
  constexpr int count = 48;
  Chain circle{"circle", false, {}, {}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    circle.points.push_back({0.5 + 0.15 * std::cos(angle), 0.5 + 0.15 * std::sin(angle)});
  }
  Warnings warnings;
  return assemble({{"wall", false, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}, circle}, {}, warnings);
}

MeshOptions with_points(const std::vector<Point>& points, double min = 0.01, double max = 0.1) {
  MeshOptions options;
  options.size.min = min;
  options.size.max = max;
  for (const Point p : points)
    options.required_points.push_back(
        {"p" + std::to_string(options.required_points.size()), p, "case.toml:1"});
  return options;
}

double smallest_angle(const Mesh& mesh) {
  double smallest = 180;
  mesh.for_each_cell([&](const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Point at = mesh.point(nodes[i]), u = mesh.point(nodes[(i + 1) % nodes.size()]) - at,
                  v = mesh.point(nodes[(i + nodes.size() - 1) % nodes.size()]) - at;
      smallest = std::min(smallest, std::atan2(cross(u, v), dot(u, v)) * 180 / std::numbers::pi);
    }
  });
  return smallest;
}

/// Expects of both types of mesh that they are sound and that each point is exactly a node. Returns the
/// smallest angle, on the root.
double expect_nodes(const Geometry& geometry, const MeshOptions& options) {
  double smallest = 180;
  test::expect_sound_meshes(geometry, options, [&](const Mesh& whole, const MeshResult&) {
    for (const RequiredPoint& point : options.required_points)
      EXPECT_EQ(std::ranges::count(whole.points, point.position), 1)
          << point.position.x << " " << point.position.y;
    smallest = std::min(smallest, smallest_angle(whole));
  });
  return smallest;
}

std::int64_t leaves_of(const Geometry& geometry, const MeshOptions& options) {
  return build_mesh(world(), geometry, options).report.leaves;
}

std::string refusal(const Geometry& geometry, const MeshOptions& options) {
  try {
    build_mesh(world(), geometry, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(RequiredPoints, AreNodesWhereverTheyLieInACell) {
  const Geometry geometry = square_with_circle();
  MeshOptions options = with_points({{0, 0}}, 0.03125, 0.0625);
  options.size.root = RootOptions{{0, 0}, 1, 1, 1};
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= i; ++j) {
      options.required_points[0].position = {0.1875 + 0.0625 * i / steps, 0.1875 + 0.0625 * j / steps};
      EXPECT_GT(expect_nodes(geometry, options), 12) << i << " " << j;
    }
  }
}

TEST(RequiredPoints, AttractNoSmallerCells) {
  const Geometry geometry = square_with_circle();
  EXPECT_EQ(leaves_of(geometry, with_points({{0.21, 0.77}, {0.2, 0.2}})),
            leaves_of(geometry, with_points({})));
}

TEST(RequiredPoints, RandomOnesAtAllSizes) {
  const Geometry geometry = square_with_circle();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in_square(0.03, 0.97);
  std::vector<Point> points;
  while (points.size() < 50) {
    const Point p{in_square(random), in_square(random)};
    const bool is_free = length(p - Point{0.5, 0.5}) > 0.18 &&
                         std::ranges::none_of(points, [&](Point q) { return length(p - q) < 0.03; });
    if (is_free) points.push_back(p);
  }
  const double without = expect_nodes(geometry, with_points({}));
  EXPECT_GT(expect_nodes(geometry, with_points(points)), without - 10);
}

TEST(RequiredPoints, TwoInOneCellGetRoom) {
  const Geometry geometry = square_with_circle();
  const MeshOptions options = with_points({{0.2, 0.2}, {0.23, 0.21}});
  EXPECT_GT(leaves_of(geometry, options), leaves_of(geometry, with_points({})));
  EXPECT_GT(expect_nodes(geometry, options), 15);
}

TEST(RequiredPoints, AFeaturePointIsANodeAnyway) {
  const Geometry geometry = square_with_circle();
  MeshOptions options = with_points({{1, 1}, {0.2, 0.2}});
  expect_nodes(geometry, options);
  const MeshResult made = build_mesh(world(), geometry, options);
  const std::vector<NamedNode> nodes = nodes_at(world(), options.required_points, made.mesh);
  ASSERT_EQ(nodes.size(), 2);
  const Mesh whole = gather_whole(world(), made.mesh);
  if (!world().is_root()) return;
  EXPECT_EQ(nodes[0].name, "p0");
  EXPECT_EQ(whole.points[nodes[0].node.value()], (Point{1, 1}));
  EXPECT_EQ(whole.points[nodes[1].node.value()], (Point{0.2, 0.2}));
}

TEST(RequiredPoints, WithoutRoomAreRefused) {
  const Geometry geometry = square_with_circle();
  EXPECT_EQ(
      refusal(geometry, with_points({{0.2, 0.01}})),
      "case.toml:1: point 'p0' at (0.2, 0.01) is 0.01 away from boundary 'wall', but must be at least 1.5 "
      "smallest cells of size 0.0125 away; move it, or reduce spacing.min to 0.00333");
  EXPECT_EQ(
      refusal(geometry, with_points({{0.2, 0.2}, {0.201, 0.2}})),
      "case.toml:1: point 'p0' at (0.2, 0.2) is 0.001 away from point 'p1' (case.toml:1), but must be at "
      "least 1.5 smallest cells of size 0.0125 away; move it, or reduce spacing.min to 0.000333");
  EXPECT_EQ(
      refusal(geometry, with_points({{0.2, 0}})),
      "case.toml:1: point 'p0' at (0.2, 0) lies on boundary 'wall', at none of its feature points; move it "
      "off the boundary, or divide the boundary there into two of different names");
  EXPECT_EQ(refusal(geometry, with_points({{0.5, 0.5}})),
            "case.toml:1: point 'p0' at (0.5, 0.5) lies outside the domain; move it inside, or remove it");
  EXPECT_EQ(refusal(geometry, with_points({{7, 0.5}})),
            "case.toml:1: point 'p0' at (7, 0.5) lies outside the domain; move it inside, or remove it");
  EXPECT_EQ(
      refusal(geometry, with_points({{1, 1}, {1, 1}})),
      "case.toml:1: point 'p0' at (1, 1) and point 'p1' (case.toml:1) are the same; remove one of them");
}

/// Throws for a point without a node on every rank.
TEST(RequiredPoints, WithoutANodeAreReported) {
  const Geometry geometry = square_with_circle();
  const MeshResult made = build_mesh(world(), geometry, with_points({}));
  EXPECT_THROW(nodes_at(world(), with_points({{0.2111, 0.2}}).required_points, made.mesh), InputError);
}

}  // namespace
}  // namespace quadloop
