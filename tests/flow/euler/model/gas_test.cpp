// The gas by hand: states and what is conserved, the free stream, wave speeds near zero.
#include "flow/euler/model/gas.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "flow/euler/model/flux.hpp"

namespace quadloop::flow::euler {
namespace {

constexpr Gas air;

TEST(Gas, StatesComeBackFromWhatIsConserved) {
  const State state{1.3, -0.7, 2.1, 0.4};
  const Conserved w = air.conserved(state);
  EXPECT_EQ(w.mass, 1.3);
  EXPECT_NEAR(w.energy, 0.4 / 0.4 + 0.5 * 1.3 * (0.49 + 4.41), 1e-14);
  const State back = air.state(w);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(back[k], state[k], 1e-14);
}

TEST(Gas, TheFreeStreamHasDensityAndSpeedOfSoundOne) {
  for (const double degrees : {0.0, 30.0, 90.0, -120.0}) {
    const State stream = air.free_stream(2.5, degrees);
    EXPECT_EQ(stream[0], 1);
    EXPECT_NEAR(air.sound_speed(stream), 1, 1e-15);
    EXPECT_NEAR(std::hypot(stream[1], stream[2]), 2.5, 1e-15);
    EXPECT_NEAR(air.total_enthalpy(stream), 1 / 0.4 + 0.5 * 2.5 * 2.5, 1e-14);
  }
  EXPECT_NEAR(air.free_stream(1, 30)[2], 0.5, 1e-15);
}

TEST(WaveSpeeds, AreSizesKeptAwayFromZeroWithoutAJump) {
  const WaveSpeeds fast = wave_speeds(3, 1);
  EXPECT_EQ(fast.fast, 4);
  EXPECT_EQ(fast.slow, 2);
  EXPECT_EQ(fast.middle, 3);
  const WaveSpeeds rest = wave_speeds(0, 1), sonic = wave_speeds(1, 1);
  EXPECT_NEAR(rest.middle, 0.01, 1e-15) << "half a fiftieth of the sound";
  EXPECT_EQ(rest.fast, 1);
  EXPECT_NEAR(sonic.slow, 0.2, 1e-15) << "half a fifth of the largest";
  double before = sonic.slow;
  for (double along = 1; along < 3; along += 1e-3) {
    const double slow = wave_speeds(along, 1).slow;
    EXPECT_NEAR(slow, before, 2e-3);
    before = slow;
  }
  const WaveSpeeds back = wave_speeds(-3, 1);
  EXPECT_EQ(back.fast, fast.slow);
  EXPECT_EQ(back.slow, fast.fast);
}

TEST(RoeAverage, LinearisesTheJump) {
  const State left{1, 0.3, -0.2, 0.7}, right{1.7, -0.4, 0.5, 1.1};
  for (const Point normal : {Point{1, 0}, Point{0.6, -0.8}}) {
    const RoeAverage mean = roe_average(air, left, right);
    const double along = mean.x_velocity * normal.x + mean.y_velocity * normal.y;
    const double d_along = (right[1] - left[1]) * normal.x + (right[2] - left[2]) * normal.y;
    const Flux l = physical_flux(air, left, normal), r = physical_flux(air, right, normal);
    EXPECT_NEAR(r[0] - l[0], (right[0] - left[0]) * along + mean.density * d_along, 1e-14);
  }
  const RoeAverage same = roe_average(air, left, left);
  EXPECT_NEAR(same.sound, air.sound_speed(left), 1e-15);
  EXPECT_EQ(same.density, 1);
}

}  // namespace
}  // namespace quadloop::flow::euler
