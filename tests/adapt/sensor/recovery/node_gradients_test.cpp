// Gradients at nodes: exact for linear fields, right on a mesh worked out by hand, the same bits on any
// number of ranks.
#include "adapt/sensor/recovery/node_gradients.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// Values at all of a part's nodes.
std::vector<double> values_of(const Mesh& mesh, const std::function<double(Point)>& value) {
  std::vector<double> values;
  for (const Point p : mesh.points) values.push_back(value(p));
  return values;
}

TEST(NodeGradients, AreExactForLinearFields) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    for (const Point p : node_gradients(world(), pieces.part, values_of(pieces.part, [](Point at) {
                                          return 2 + 3 * at.x - 5 * at.y;
                                        }))) {
      EXPECT_NEAR(p.x, 3, 1e-13);
      EXPECT_NEAR(p.y, -5, 1e-13);
    }
  });
}

TEST(NodeGradients, OfConstantFieldsAreZero) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    for (const Point p :
         node_gradients(world(), pieces.part, values_of(pieces.part, [](Point) { return 0.1; })))
      EXPECT_EQ(p, Point{});
  });
}

TEST(NodeGradients, AreMeansOverTheCellsRoundANode) {
  Mesh mesh;  // a square beside a triangle of half its area
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
  mesh.owned_nodes = 5;
  mesh.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  mesh.triangles = {{NodeId{1}, NodeId{4}, NodeId{2}}};
  const Mesh part = test::Pieces(mesh, own_order(mesh)).part;
  // x^2: slope 1 in the square, 3 in the triangle.
  const std::vector<Point> gradients =
      node_gradients(world(), part, values_of(part, [](Point p) { return p.x * p.x; }));
  const Point expected[] = {{1, 0}, {5.0 / 3, 0}, {5.0 / 3, 0}, {1, 0}, {3, 0}};
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const Point wanted = expected[part.global(NodeId{static_cast<std::int32_t>(i)}).value()];
    EXPECT_NEAR(gradients[i].x, wanted.x, 1e-15);
    EXPECT_NEAR(gradients[i].y, wanted.y, 1e-15);
  }
}

TEST(NodeGradients, HaveTheSameBitsOnAnyNumberOfRanks) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const auto value = [](Point p) { return std::sin(7 * p.x) * std::cos(5 * p.y) + 0.3 * p.x; };
    const std::vector<Point> whole =
        node_gradients(Communicator(MPI_COMM_SELF), pieces.whole, values_of(pieces.whole, value));
    const std::vector<Point> part = node_gradients(world(), pieces.part, values_of(pieces.part, value));
    ASSERT_EQ(part.size(), pieces.part.points.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
      EXPECT_EQ(part[i], whole[pieces.part.global(NodeId{static_cast<std::int32_t>(i)}).value()]);
    }
  });
}

}  // namespace
}  // namespace quadloop::adapt
