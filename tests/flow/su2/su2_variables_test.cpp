// Primitive variables of a flow as SU2 leaves it.
#include "flow/su2/su2_variables.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop::flow {
namespace {

using Names = std::vector<std::string>;

/// Density 2, velocity (3, -4), pressure 5, behind a turbulence variable.
const Field flow{{"Density", "Momentum_x", "Momentum_y", "Energy", "Nu_Tilde"}, {2, 6, -8, 37.5, 7}, {}};

TEST(Su2Variables, FollowFromTheConservativeOnes) {
  const Field more = with_primitive_variables(flow, 1.4);
  EXPECT_EQ(more.names, (Names{"Density", "Momentum_x", "Momentum_y", "Energy", "Nu_Tilde", "x_velocity",
                               "y_velocity", "pressure", "mach", "total_pressure"}));
  ASSERT_EQ(more.values.size(), 10);
  EXPECT_EQ(more.values[5], 3);
  EXPECT_EQ(more.values[6], -4);
  EXPECT_NEAR(more.values[7], 5, 1e-14);
  EXPECT_NEAR(more.values[8], 5 / std::sqrt(1.4 * 5 / 2), 1e-14);
  // Brought to rest without losses: the energy of motion raises the enthalpy, and p / density^gamma stays.
  const double at_rest = 1 + 12.5 / (1.4 / 0.4 * 5 / 2);
  EXPECT_NEAR(more.values[9], 5 * std::pow(at_rest, 3.5), 1e-12);
}

TEST(Su2Variables, AreNotMadeTwice) {
  Field with_pressure = flow;
  with_pressure.names[4] = "Pressure";
  EXPECT_EQ(with_primitive_variables(with_pressure, 1.4).names,
            (Names{"Density", "Momentum_x", "Momentum_y", "Energy", "Pressure", "x_velocity", "y_velocity",
                   "mach", "total_pressure"}));
}

TEST(Su2Variables, GoAwayAgainBeforeARestart) {
  const Field less = without_primitive_variables(with_primitive_variables(flow, 1.4));
  EXPECT_EQ(less.names, flow.names);
  EXPECT_EQ(less.values, flow.values);
}

TEST(Su2Variables, OfAnotherFlowAreLeftAlone) {
  const Field other{{"pressure", "x_velocity"}, {1, 2}, {}};
  EXPECT_EQ(with_primitive_variables(other, 1.4).names, other.names);
  EXPECT_EQ(without_primitive_variables(other).names, other.names);
  EXPECT_EQ(without_primitive_variables({}).width(), 0);
}

TEST(Su2Variables, WithoutPressureThereIsNoMachNumber) {
  const Field still{{"Density", "Momentum_x", "Momentum_y", "Energy"}, {1, 1, 0, 0.5}, {}};
  const Field more = with_primitive_variables(still, 1.4);
  EXPECT_EQ(more.values[7], 0);
  EXPECT_EQ(more.values[8], 0) << "nor a total pressure";
}

}  // namespace
}  // namespace quadloop::flow
