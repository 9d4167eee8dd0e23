#include "flow/euler/scheme/far_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

struct Ring {
  explicit Ring(double mach) : mesh{test::ring_mesh(32, 8, 0.5, 10)}, dual{world(), mesh} {
    EulerOptions options;
    options.mach = mach;
    options.alpha = 5;
    model = flow_model(world(), mesh, options);
  }
  Mesh mesh;
  DualMesh dual;
  FlowModel model;
};

/// Clockwise, by the mean over places on a circle.
double circulation(const FarField& far_field, double radius) {
  constexpr int places = 360;
  double sum = 0;
  for (int k = 0; k < places; ++k) {
    const double angle = 2 * std::numbers::pi * k / places;
    const Point way{std::cos(angle), std::sin(angle)};
    const State state = far_field.at(radius * way);
    sum += state[1] * way.y - state[2] * way.x;
  }
  return 2 * std::numbers::pi * radius * sum / places;
}

TEST(FarField, IsTheFreeStreamWithoutLift) {
  const Ring ring(0.5);
  FarField far_field(world(), ring.dual, ring.model);
  EXPECT_EQ(far_field.at({3, 4}), ring.model.free_stream);
}

TEST(FarField, HasTheCirculationOfTheLift) {
  for (const double mach : {0.1, 0.6}) {
    const Ring ring(mach);
    FarField far_field(world(), ring.dual, ring.model);
    far_field.set_circulation(0.2);
    EXPECT_NEAR(circulation(far_field, 5), 0.2, 1e-9);
    EXPECT_NEAR(circulation(far_field, 50), 0.2, 1e-9);
    EXPECT_LT(far_field.at({20, 0})[2], ring.model.free_stream[2]);  // the wash behind goes down
  }
}

TEST(FarField, KeepsTotalEnthalpyAndEntropy) {
  const Ring ring(0.6);
  FarField far_field(world(), ring.dual, ring.model);
  far_field.set_circulation(2);
  const State state = far_field.at({3, 1});
  EXPECT_GT(std::abs(state[0] - 1), 0.01);
  EXPECT_NEAR(ring.model.gas.total_enthalpy(state), ring.model.gas.total_enthalpy(ring.model.free_stream),
              1e-12);
  EXPECT_NEAR(state[3] * 1.4, std::pow(state[0], 1.4), 1e-12);
}

TEST(FarField, HasNoVortexFasterThanSound) {
  const Ring ring(1.5);
  FarField far_field(world(), ring.dual, ring.model);
  far_field.set_circulation(2);
  EXPECT_EQ(far_field.at({3, 1}), ring.model.free_stream);
}

}  // namespace
}  // namespace quadloop::flow::euler
