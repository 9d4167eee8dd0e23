// The edge of a boundary layer in given profiles.
#include "adapt/remesh/boundary_layer/layer_edge.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace quadloop::adapt {
namespace {

/// Samples of u(y) and du/dy, 5 % apart.
template <class Velocity, class Shear>
std::vector<ProfileSample> profile_of(double first, double last, const Velocity& velocity,
                                      const Shear& shear) {
  std::vector<ProfileSample> profile;
  for (double y = first; y <= last; y *= 1.05) profile.push_back({y, velocity(y), shear(y)});
  return profile;
}

/// Blasius's profile over y sqrt(U / (nu x)), by Runge-Kutta steps of f''' = -f f'' / 2.
std::vector<ProfileSample> blasius() {
  using State = std::array<double, 3>;
  State state{0, 0, 0.33206};
  constexpr double step = 0.05;
  const auto slope = [](const State& s) { return State{s[1], s[2], -0.5 * s[0] * s[2]}; };
  const auto moved = [](const State& s, const State& by, double h) {
    return State{s[0] + h * by[0], s[1] + h * by[1], s[2] + h * by[2]};
  };
  std::vector<ProfileSample> profile;
  for (int k = 1; k * step < 12; ++k) {
    const State a = slope(state), b = slope(moved(state, a, step / 2)), c = slope(moved(state, b, step / 2)),
                d = slope(moved(state, c, step));
    for (std::size_t i = 0; i < 3; ++i) state[i] += step / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    profile.push_back({k * step, state[1], state[2]});
  }
  return profile;
}

TEST(LayerEdge, OfALaminarLayerIsWhereVelocityHasReached99Percent) {
  const auto edge = layer_edge(blasius());
  ASSERT_TRUE(edge.has_value());
  EXPECT_NEAR(*edge, 4.91, 0.1 * 4.91);
}

/// Coles's profile of zero pressure gradient, in the logarithmic region and the wake, with a sublayer.
TEST(LayerEdge, OfATurbulentLayerIsItsThickness) {
  constexpr double kappa = 0.41, of_wake = 0.55, pi = 3.14159265358979;
  for (const double thickness : {500.0, 2000.0, 20000.0}) {  // wall units
    const auto velocity = [&](double y) {
      if (y < 11) return y;
      const double inner = std::log(std::min(y, thickness) / 11) / kappa + 11;
      return inner + 2 * of_wake / kappa * std::pow(std::sin(pi / 2 * std::min(y / thickness, 1.0)), 2);
    };
    const auto shear = [&](double y) { return (velocity(1.001 * y) - velocity(0.999 * y)) / (0.002 * y); };
    const auto edge = layer_edge(profile_of(0.5, 5 * thickness, velocity, shear));
    ASSERT_TRUE(edge.has_value()) << thickness;
    EXPECT_NEAR(*edge, thickness, 0.06 * thickness);
  }
}

double error_function_shear(double y) { return 2 / std::sqrt(3.14159265358979) * std::exp(-y * y); }

TEST(LayerEdge, DoesNotDependOnTheDirectionOfTheFlow) {
  const auto shear = error_function_shear;
  const auto edge = layer_edge(profile_of(
      0.01, 10, [](double y) { return std::erf(y); }, shear));
  const auto backwards = layer_edge(profile_of(
      0.01, 10, [](double y) { return -std::erf(y); }, [&](double y) { return -shear(y); }));
  ASSERT_TRUE(edge.has_value());
  EXPECT_EQ(edge, backwards);
}

/// A wake above the boundary layer, and the shear of the flow outside, are not part of it.
TEST(LayerEdge, IsBelowAWakeAndInAShearedFlow) {
  const auto alone = layer_edge(profile_of(
      0.01, 10, [](double y) { return std::erf(y); }, error_function_shear));
  const auto wake = [](double y) { return -0.6 * std::exp(-std::pow((y - 4) / 0.7, 2)); };
  const auto with_wake = layer_edge(profile_of(
      0.01, 10, [&](double y) { return std::erf(y) + wake(y); },
      [&](double y) { return error_function_shear(y) - 2 * (y - 4) / 0.49 * wake(y); }));
  const auto sheared = layer_edge(profile_of(
      0.01, 10, [](double y) { return std::erf(y) - 0.02 * y; },
      [](double y) { return error_function_shear(y) - 0.02; }));
  ASSERT_TRUE(alone && with_wake && sheared);
  EXPECT_NEAR(*with_wake, *alone, 0.05 * *alone);
  EXPECT_NEAR(*sheared, *alone, 0.1 * *alone);
}

TEST(LayerEdge, IsUnknownInSeparatedFlowAndWithoutALayer) {
  const auto one = [](double) { return 1.0; };
  EXPECT_FALSE(layer_edge({}).has_value());
  EXPECT_FALSE(layer_edge(profile_of(
                              0.01, 10, [](double y) { return std::tanh(y - 1); },
                              [](double y) { return 1 / std::pow(std::cosh(y - 1), 2); }))
                   .has_value())
      << "reversed near the wall";
  EXPECT_FALSE(layer_edge(profile_of(0.01, 1, one, one)).has_value()) << "no end within the samples";
  EXPECT_FALSE(
      layer_edge(profile_of(0.01, 10, one, [](double y) { return 0.01 * std::exp(-y); })).has_value())
      << "slip along the wall";
  EXPECT_FALSE(layer_edge(profile_of(0.01, 10, one, [](double) { return 0.0; })).has_value());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(layer_edge(profile_of(0.01, 10, one, [](double) { return nan; })).has_value());
}

}  // namespace
}  // namespace quadloop::adapt
