// What watches a steady run: swings of single nodes, a residual that stalls or rises, and what is said of a
// run that did not converge.
#include <gtest/gtest.h>

#include "flow/euler/residual_watch.hpp"
#include "flow/euler/shortfall.hpp"
#include "flow/euler/step_fractions.hpp"

namespace quadloop::flow::euler {
namespace {

TEST(StepFractions, FallWhereChangesSwingAndGrowAgain) {
  StepFractions shares(2);
  for (int step = 0; step < 30; ++step) {
    const float sign = step % 2 == 0 ? 1.F : -1.F;
    shares.follow(IdVector<NodeId, Change>({Change{sign, 0, 0, sign}, Change{1, 0, 0, 1}}));
  }
  EXPECT_LT(shares.shares()[NodeId{0}], 0.1);
  EXPECT_EQ(shares.shares()[NodeId{1}], 1);
  const double least = shares.shares()[NodeId{0}];
  for (int step = 0; step < 50; ++step)
    shares.follow(IdVector<NodeId, Change>({Change{1, 0, 0, 1}, Change{1, 0, 0, 1}}));
  EXPECT_GT(shares.shares()[NodeId{0}], 2 * least);
  shares.restart();
  EXPECT_EQ(shares.shares()[NodeId{0}], 1);
}

TEST(StepFractions, StayWhereSwingsDieOutFast) {
  StepFractions shares(1);
  float change = 1;
  for (int step = 0; step < 30; ++step)
    shares.follow(IdVector<NodeId, Change>({Change{change *= -0.7F, 0, 0, 0}}));
  EXPECT_EQ(shares.shares()[NodeId{0}], 1);
}

TEST(StallWatch, TellsASlowFallFromAFastOne) {
  StallWatch falling, standing;
  double residual = 0.04;
  for (int step = 0; step < 100; ++step) {
    falling.add(residual *= 0.95);
    standing.add(0.5);
  }
  EXPECT_FALSE(falling.is({14, 0.5}));
  EXPECT_TRUE(falling.is({13, 0.5}));
  EXPECT_FALSE(standing.is({100, 0.5})) << "there is no flow so many steps ago";
  EXPECT_FALSE(falling.is_slow());
  EXPECT_TRUE(standing.is_slow());
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

TEST(Patience, EndsAfterStepsOnEnd) {
  Patience patience(3);
  for (const bool is_so : {true, true, false, true, true}) EXPECT_FALSE(patience.ends(is_so));
  EXPECT_TRUE(patience.ends(true));
  EXPECT_FALSE(patience.ends(true)) << "told once, then counted anew";
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
  EXPECT_TRUE(says("increase solver.iterations"));
  result.stalled = true;
  EXPECT_TRUE(says("increase solver.tolerance"));
  EXPECT_FALSE(says("increase solver.iterations"));
  result.kept_iteration = 120;
  result.last_residual = 0.1;
  EXPECT_TRUE(says("fell to 1.00e-04 at step 120 and then rose to 1.00e-01; the flow at step 120 is kept"));
  EXPECT_FALSE(says("increase solver.iterations"));
}

}  // namespace
}  // namespace quadloop::flow::euler
