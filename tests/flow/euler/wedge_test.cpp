// The shock from a wedge of 10 degrees at Mach 2: theory gives an angle of 39.3139 degrees and a pressure
// ratio of 1.706579.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/euler/solve_euler.hpp"
#include "tests/flow/euler/flow_meshes.hpp"

namespace quadloop::flow {
namespace {

constexpr std::int32_t n = 72;

/// One run for all tests.
struct WedgeFlow {
  Mesh mesh = test::wedge_mesh(n, 10);
  EulerResult result;

  WedgeFlow() {
    const Communicator self(MPI_COMM_SELF);
    EulerOptions options;
    options.mach = 2;
    options.tolerance = 1e-6;
    options.iterations = 500;
    result = solve_euler(self, mesh, options);
  }
  double pressure_ratio(std::int32_t i, std::int32_t j) const {
    return 1.4 * result.flow.values[4 * (j * (n + 1) + i) + 3];
  }

  /// Where the pressure of a column falls through the middle of the jump.
  Point shock(std::int32_t i) const {
    constexpr double middle = (1 + 1.706579) / 2;
    for (std::int32_t j = n - 1; j >= 0; --j) {
      const double above = pressure_ratio(i, j + 1), below = pressure_ratio(i, j);
      if (below < middle) continue;
      const double share = (middle - below) / (above - below);
      const auto at = [&](std::int32_t k) { return mesh.points[k * (n + 1) + i]; };
      return at(j) + share * (at(j + 1) - at(j));
    }
    return {};
  }
};

const WedgeFlow& flow() {
  static const WedgeFlow one;
  return one;
}

TEST(Wedge, Converges) {
  EXPECT_TRUE(flow().result.converged) << flow().result.residual << " after " << flow().result.iterations;
}

TEST(Wedge, HasThePressureOfTheory) {
  double sum = 0;
  int count = 0;
  for (std::int32_t i = n / 2; i < n; ++i, ++count) sum += flow().pressure_ratio(i, 0);
  EXPECT_NEAR(sum / count, 1.706579, 0.0170);
}

TEST(Wedge, HasTheShockAngleOfTheory) {
  const Point near = flow().shock(n / 2), far = flow().shock(n - 6);
  EXPECT_NEAR(std::atan2(far.y - near.y, far.x - near.x) * 180 / std::numbers::pi, 39.3139, 0.5);
}

TEST(Wedge, PushesTheWall) {
  const double push = (1.706579 - 1) / 1.4 / (0.5 * 4);  // on a wall of length 1 along x
  EXPECT_NEAR(flow().result.cd, push * std::tan(10 * std::numbers::pi / 180), 0.001);
  EXPECT_NEAR(flow().result.cl, -push, 0.005);
}

}  // namespace
}  // namespace quadloop::flow
