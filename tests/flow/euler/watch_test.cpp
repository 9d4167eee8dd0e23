// What watches a steady run: swings of single nodes, a residual that stalls or rises, and what is said of a
// run that did not converge.
#include <gtest/gtest.h>

#include "flow/euler/residual_watch.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/euler/step_shares.hpp"

namespace quadloop::euler {
namespace {

TEST(StepShares, FallWhereChangesSwingAndGrowAgain) {
  StepShares shares(2);
  for (int step = 0; step < 30; ++step) {
    const float sign = step % 2 == 0 ? 1.F : -1.F;
    shares.follow({Change{sign, 0, 0, sign}, Change{1, 0, 0, 1}});
  }
  EXPECT_LT(shares.shares()[0], 0.1);
  EXPECT_EQ(shares.shares()[1], 1);
  const double least = shares.shares()[0];
  for (int step = 0; step < 50; ++step) shares.follow({Change{1, 0, 0, 1}, Change{1, 0, 0, 1}});
  EXPECT_GT(shares.shares()[0], 2 * least);
  shares.restart();
  EXPECT_EQ(shares.shares()[0], 1);
}

TEST(StepShares, StayWhereSwingsDieOutFast) {
  StepShares shares(1);
  float change = 1;
  for (int step = 0; step < 30; ++step) shares.follow({Change{change *= -0.7F, 0, 0, 0}});
  EXPECT_EQ(shares.shares()[0], 1);
}

TEST(StallWatch, TellsASlowFallFromAFastOne) {
  StallWatch fast, slow, early, waves;
  double quick = 0.04, lame = 0.04, far = 0.04;
  bool fast_stalls = false, slow_stalls = false, early_stalls = false, waves_stall = false;
  for (int step = 0; step < 100; ++step) {
    fast_stalls |= fast.stalls(quick *= 0.9);
    slow_stalls |= slow.stalls(lame *= 0.95);
    if (step < 45) waves_stall |= waves.stalls(far *= 0.95);  // to 4e-3: waves in the far field, say
    early_stalls |= early.stalls(0.5);
  }
  EXPECT_FALSE(fast_stalls);
  EXPECT_TRUE(slow_stalls);
  EXPECT_FALSE(waves_stall);
  EXPECT_FALSE(early_stalls);  // shocks still move
  EXPECT_FALSE(slow.is_slow());
  EXPECT_TRUE(early.is_slow());
}

TEST(SwingWatch, TellsASwingFromATransient) {
  SwingWatch swing, transient, falling, still;
  bool swings = false, transient_swings = false, falling_swings = false, still_swings = false;
  for (int step = 0; step < 200; ++step) {
    const double to_and_fro = step % 3 == 0 ? 0.14 : 0.22;
    swings |= swing.swings(to_and_fro);
    transient_swings |= transient.swings(0.7 + 0.02 * (step % 2));  // shocks on their way
    falling_swings |= falling.swings(to_and_fro * std::exp(-0.02 * step));
    still_swings |= still.swings(0);
  }
  EXPECT_TRUE(swings);
  EXPECT_FALSE(transient_swings);
  EXPECT_FALSE(falling_swings);
  EXPECT_FALSE(still_swings);
}

TEST(RiseWatch, WaitsForARiseThatLasts) {
  RiseWatch watch;
  for (int step = 0; step < 100; ++step) EXPECT_FALSE(watch.rises(step % 10 == 0 ? 1e-6 : 1e-4, 1e-6));
  int steps = 0;
  while (!watch.rises(1e-4, 1e-6)) ++steps;
  EXPECT_LT(steps, 25);
  for (int step = 0; step < 100; ++step) EXPECT_FALSE(watch.rises(1, 0.09));  // the start's own transient
}

TEST(CflLimit, GrowsBackToLessThanBefore) {
  CflLimit limit;
  limit.lower(0.5);
  EXPECT_LT(limit.share(), 0.2);
  for (int step = 0; step < 100; ++step) limit.recover();
  EXPECT_EQ(limit.share(), 0.5);
}

TEST(BestFlow, IsKeptOnlyRatherThanAClearlyWorseOne) {
  BestFlow best;
  EXPECT_TRUE(best.improves(0, 1, false));
  EXPECT_FALSE(best.keeps(5));  // an undisturbed start is no flow
  EXPECT_TRUE(best.improves(7, 1e-3, false));
  EXPECT_FALSE(best.improves(8, 2e-3, false));
  EXPECT_FALSE(best.keeps(1.5e-3));
  EXPECT_TRUE(best.keeps(0.1));
}

TEST(Shortfall, SaysWhatHelps) {
  EulerOptions options;
  EulerResult result;
  result.iterations = result.kept_iteration = 300;
  result.residual = 1e-4;
  const auto says = [&](const char* what) {
    return shortfall(result, options).find(what) != std::string::npos;
  };
  EXPECT_TRUE(says("raise solver.iterations"));
  result.stalled = true;
  EXPECT_TRUE(says("raise solver.tolerance"));
  EXPECT_FALSE(says("raise solver.iterations"));
  result.kept_iteration = 120;
  result.last_residual = 0.1;
  EXPECT_TRUE(says("fell to 1.00e-04 at step 120 and then rose to 1.00e-01; the flow at step 120 is kept"));
  EXPECT_FALSE(says("raise solver.iterations"));
}

TEST(StandstillWatch, TellsOfFourEqualResidualsInARow) {
  StandstillWatch watch;
  for (const double residual : {0.5, 0.25, 0.25, 0.25, 0.125, 0.25, 0.25, 0.25})
    EXPECT_FALSE(watch.stands(residual));
  EXPECT_TRUE(watch.stands(0.25));
  EXPECT_FALSE(watch.stands(0.25)) << "told once, then counted anew";
}

}  // namespace
}  // namespace quadloop::euler
