#include "flow/euler/implicit/gmres.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/world.hpp"

namespace quadloop::euler {
namespace {

using test::world;

constexpr std::size_t nodes = 40;

/// A matrix with four eigenvalues, not symmetric: GMRES needs no more than that many directions.
void multiply(const Gmres::Vector& vector, Gmres::Vector& result) {
  for (std::size_t node = 0; node < vector.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) {
      result[node][k] = static_cast<double>(k + 1) * vector[node][k];
      if (k + 1 < 4) result[node][k] += 0.3 * vector[node][k + 1];
    }
  }
}

void keep(const Gmres::Vector& vector, std::vector<Change>& change) {
  change.resize(vector.size());
  for (std::size_t node = 0; node < vector.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) change[node][k] = static_cast<float>(vector[node][k]);
  }
}

Gmres::Vector right_side() {
  Gmres::Vector right(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    for (std::size_t k = 0; k < 4; ++k)
      right[node][k] = std::sin(1.0 + static_cast<double>(4 * node + k) + 100.0 * world().rank());
  }
  return right;
}

/// Of the equation, relative to the right side.
double error(Gmres& gmres, const Gmres::Vector& right, const Gmres::Vector& solution) {
  Gmres::Vector rest(nodes);
  multiply(solution, rest);
  for (std::size_t node = 0; node < nodes; ++node) {
    for (std::size_t k = 0; k < 4; ++k) rest[node][k] -= right[node][k];
  }
  return gmres.norm(rest) / gmres.norm(right);
}

TEST(Gmres, NeedsAsManyDirectionsAsTheMatrixHasEigenvalues) {
  Gmres gmres(world(), nodes, 6);
  Gmres::Vector solution(nodes);
  const Gmres::Vector right = right_side();
  int products = 0;
  const auto counted = [&](const Gmres::Vector& vector, Gmres::Vector& result) {
    ++products;
    multiply(vector, result);
  };
  const double left_over = gmres.solve(right, 1e-6, counted, keep, solution);
  EXPECT_LT(left_over, 1e-6);
  EXPECT_LE(products, 5);  // the preconditioner rounds to single precision
  EXPECT_NEAR(error(gmres, right, solution), left_over, 1e-8);
}

TEST(Gmres, TellsWhatIsLeftWhereDirectionsAreFew) {
  Gmres gmres(world(), nodes, 2);
  Gmres::Vector solution(nodes);
  const Gmres::Vector right = right_side();
  const double left_over = gmres.solve(right, 1e-6, multiply, keep, solution);
  EXPECT_GT(left_over, 1e-3);
  EXPECT_LT(left_over, 0.5);
  EXPECT_NEAR(error(gmres, right, solution), left_over, 1e-6);
}

TEST(Gmres, FindsNothingForNothing) {
  Gmres gmres(world(), nodes, 2);
  Gmres::Vector solution(nodes, Flux{1, 1, 1, 1});
  EXPECT_EQ(gmres.solve(Gmres::Vector(nodes), 0.1, multiply, keep, solution), 0);
  EXPECT_EQ(solution[0], Flux{});
}

}  // namespace
}  // namespace quadloop::euler
