#include "flow/euler/implicit/krylov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

constexpr std::int32_t own_rows = 7;

/// Each rank's own rows, coupled within the row alone: not symmetric, and of another size in each row.
void multiply(NodeRows& x, NodeRows& product) {
  product = NodeRows(x.size());
  for (const NodeId i : ids_below(NodeId{own_rows})) {
    for (std::size_t k = 0; k < 4; ++k)
      product[i][k] = (2 + i.value() + static_cast<double>(k)) * x[i][k] + 0.7 * x[i][(k + 1) % 4];
  }
}

KrylovSystem system_of_rows() {
  KrylovSystem system;
  system.owned = own_rows;
  system.multiply = multiply;
  system.precondition = [](const NodeRows& right, NodeRows& x) { x = right; };
  return system;
}

NodeRows right_side() {
  NodeRows right(own_rows + 2);  // two that do not count
  for (const NodeId i : right.ids()) {
    for (std::size_t k = 0; k < 4; ++k) right[i][k] = std::cos(4 * i.value() + static_cast<double>(k));
  }
  return right;
}

TEST(Krylov, SolvesASystemThatIsNotSymmetric) {
  for (const int restart : {40, 5}) {
    NodeRows x, product;
    const NodeRows right = right_side();
    const KrylovEnd end = solve_by_gmres(test::world(), system_of_rows(), right, x, 1e-12, 400, restart);
    EXPECT_LE(end.residual, 1e-12) << restart;
    EXPECT_LE(end.iterations, restart == 40 ? 28 : 200);
    multiply(x, product);
    for (const NodeId i : ids_below(NodeId{own_rows})) {
      for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(product[i][k], right[i][k], 1e-11);
    }
  }
}

/// Of sizes that differ by a factor of 1e7: what is left over of the basis does not spoil the end.
TEST(Krylov, SolvesABadlyScaledSystemInOneGo) {
  KrylovSystem system = system_of_rows();
  const auto factor = [](NodeId i) { return std::pow(10.0, i.value()); };
  system.multiply = [&](NodeRows& x, NodeRows& product) {
    multiply(x, product);
    for (const NodeId i : ids_below(NodeId{own_rows})) {
      for (double& value : product[i]) value *= factor(i);
    }
  };
  NodeRows x;
  const KrylovEnd end = solve_by_gmres(test::world(), system, right_side(), x, 1e-9, 28, 28);
  EXPECT_LE(end.residual, 1e-9);
}

TEST(Krylov, StopsAtWhatIsNoNumber) {
  KrylovSystem system = system_of_rows();
  system.multiply = [&](NodeRows& x, NodeRows& product) {
    multiply(x, product);
    if (test::world().is_root()) product[NodeId{3}][1] = std::numeric_limits<double>::quiet_NaN();
  };
  NodeRows x;
  EXPECT_LE(solve_by_gmres(test::world(), system, right_side(), x, 1e-9, 28, 28).iterations, 1);
}

TEST(Krylov, EndsWhereItMay) {
  NodeRows x;
  EXPECT_EQ(solve_by_gmres(test::world(), system_of_rows(), right_side(), x, 1e-12, 5, 5).iterations, 5);
  const KrylovEnd nothing =
      solve_by_gmres(test::world(), system_of_rows(), NodeRows(own_rows), x, 1e-12, 50, 5);
  EXPECT_EQ(nothing.iterations, 0);
  EXPECT_EQ(nothing.residual, 0);
}

}  // namespace
}  // namespace quadloop::flow::euler
