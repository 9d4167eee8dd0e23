#include "flow/euler/scheme/far_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/euler/scheme/shock_sensor.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::euler {
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

TEST(ShockSensor, SeesStrongShocksAlone) {
  const Ring ring(2);
  ShockSensor sensor(ring.dual, ring.model.free_stream[3]);
  const auto strongest = [&](double ratio) {
    std::vector<State> states(ring.dual.nodes(), ring.model.free_stream);
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(states.size()); ++node) {
      if (ring.dual.point(node).x > 0) states[node][3] *= ratio;
    }
    sensor.find(states);
    double most = 0;
    for (const DualEdge& edge : ring.dual.edges()) most = std::max(most, sensor.least_middle(edge));
    return most;
  };
  EXPECT_EQ(strongest(1), 0);
  EXPECT_EQ(strongest(1.6), 0);
  EXPECT_GT(strongest(2.2), 0.05);
  EXPECT_NEAR(strongest(10), 0.3, 1e-12);
  EXPECT_LT(strongest(0.01), 0.1);  // to a vacuum: no more than the free stream's pressure counts
  sensor.freeze();
  const double kept = strongest(10);
  EXPECT_EQ(strongest(1), kept);
}

}  // namespace
}  // namespace quadloop::euler
