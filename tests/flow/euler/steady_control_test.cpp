// How a steady march goes on: phases, setbacks, when the limiter is frozen, when Newton steps are taken.
#include "flow/euler/steady_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flow/euler/steady_parameters.hpp"

namespace quadloop::flow::euler {
namespace {

using Next = SteadyControl::Next;
using Phase = SteadyControl::Phase;
using Limiter = SteadyControl::Limiter;

/// The decisions on residuals that follow each other.
struct March {
  explicit March(bool is_given = false, bool may_leave = false) : control(is_given, may_leave) {}

  SteadyControl::Decision at(double residual, Limiter limiter = Limiter::none) {
    return control.decide({iteration++, residual, limiter, false});
  }
  SteadyControl control;
  int iteration = 0;
};

/// At which step the limiter is frozen, if the residual goes from `first` by `factor` each step; -1: never.
int frozen_at(double first, double factor, int steps) {
  March march;
  for (int step = 0; step < steps; ++step) {
    if (march.at(first *= factor, Limiter::live).freeze_limiter) return step;
  }
  return -1;
}

TEST(SteadyControl, FreezesTheLimiterWhereADevelopedResidualFallsSlowly) {
  EXPECT_EQ(frozen_at(0.04, 0.9, 100), -1);
  EXPECT_NE(frozen_at(0.04, 0.95, 100), -1);
  EXPECT_EQ(frozen_at(0.04, 0.95, 45), -1) << "to 4e-3: waves in the far field, say";
  EXPECT_EQ(frozen_at(0.5, 0.9999, 100), -1) << "shocks still move";
}

TEST(SteadyControl, FreezesNoLimiterThatIsNotLive) {
  March march;
  double residual = 0.04;
  for (int step = 0; step < 100; ++step)
    EXPECT_FALSE(march.at(residual *= 0.99, Limiter::frozen).freeze_limiter);
}

TEST(SteadyControl, CallsNewtonNearTheEndAndMirrorsTheFlowOnceBefore) {
  March march;
  EXPECT_EQ(march.at(0.006).next, Next::plain_step);
  const SteadyControl::Decision called = march.at(0.004);
  EXPECT_EQ(called.next, Next::newton_step);
  EXPECT_TRUE(called.mirror);
  EXPECT_EQ(march.control.phase(), Phase::newton);
  EXPECT_FALSE(march.at(0.003).mirror);
  EXPECT_EQ(march.at(0.06).next, Next::plain_step) << "no longer a developed flow";
}

TEST(SteadyControl, RestsLongerAfterEachFailedNewtonStep) {
  March march;
  double residual = 4e-3;
  std::vector<int> rests;
  for (int failure = 0; failure < 6; ++failure) {
    int rest = 0;
    while (march.at(residual *= 0.99).next != Next::newton_step) ++rest;
    rests.push_back(rest);
    march.control.learn({march.iteration, residual, Limiter::none, false}, 0.25, 0.1);
    EXPECT_EQ(march.control.phase(), Phase::pause);
  }
  EXPECT_EQ(rests, (std::vector<int>{0, 5, 10, 20, 40, 40}));
}

TEST(SteadyControl, FreezesALiveLimiterAtWhichANewtonStepFailed) {
  for (const double residual : {4e-3, 2e-3}) {
    March march;
    EXPECT_EQ(march.at(residual, Limiter::live).next, Next::newton_step);
    const bool freezes = march.control.learn({0, residual, Limiter::live, false}, 0, 0.1);
    EXPECT_EQ(freezes, residual < steady_parameters.freezing.settled);
    EXPECT_EQ(march.at(0.9 * residual, Limiter::frozen).next, freezes ? Next::newton_step : Next::plain_step);
  }
}

TEST(SteadyControl, RaisesNewtonsCflWhereStepsAreWholeAndSystemsSolved) {
  SteadyControl control(false, false);
  const auto learnt = [&](double share, double left_over) {
    control.learn({}, share, left_over);
    return control.newton_cfl(100);
  };
  EXPECT_EQ(control.newton_cfl(100), 100);
  EXPECT_EQ(learnt(1, 0.1), 300);
  EXPECT_EQ(learnt(0.5, 0.1), 300);
  EXPECT_EQ(learnt(1, 0.6), 150);
  for (int step = 0; step < 9; ++step) control.learn({}, 0, 0.1);
  EXPECT_EQ(control.newton_cfl(100), 10);
}

TEST(SteadyControl, LetsTheCflNumberFollowTheResidual) {
  const SteadyControl control(false, false);
  EXPECT_EQ(control.cfl(20, 3), 20);
  EXPECT_NEAR(control.cfl(20, 1e-2), 20 * std::pow(10, 1.5), 1e-9);
  EXPECT_EQ(control.cfl(20, 1e-9), 1000);
}

TEST(SteadyControl, ReturnsToTheBestFlowAfterARiseThatLasts) {
  March march;
  EXPECT_TRUE(march.at(0.01).is_best);
  int steps = 0;
  SteadyControl::Decision decision;
  while ((decision = march.at(0.2 + 0.001 * steps)).next == Next::plain_step) ++steps;
  EXPECT_EQ(steps, 19);
  EXPECT_EQ(decision.next, Next::return_to_best);
  ASSERT_EQ(decision.messages.size(), 1);
  EXPECT_NE(decision.messages[0].find("rose from 1.00e-02 at step 0"), std::string::npos);
  EXPECT_LT(march.control.cfl(20, 2), 0.2 * 20);
  March early;
  EXPECT_TRUE(early.at(0.09).is_best);
  for (int step = 0; step < 60; ++step)
    EXPECT_EQ(early.at(1 + 0.001 * step).next, Next::plain_step) << "the start's own transient";
}

TEST(SteadyControl, ReturnsFromAStandstillOfFourEqualResiduals) {
  March march;
  for (const double residual : {0.5, 0.25, 0.25, 0.25, 0.125, 0.25, 0.25, 0.25})
    EXPECT_EQ(march.at(residual).next, Next::plain_step);
  EXPECT_EQ(march.at(0.25).next, Next::return_to_best);
  EXPECT_EQ(march.at(0.25).next, Next::plain_step) << "counted anew";
}

TEST(SteadyControl, EndsAFlowThatBlowsUpForTheNinthTime) {
  March march;
  march.at(0.5);
  for (int failure = 0; failure < 8; ++failure)
    EXPECT_EQ(march.at(failure % 2 == 0 ? 2000 : std::numeric_limits<double>::quiet_NaN()).next,
              Next::return_to_best);
  EXPECT_EQ(march.at(2000).next, Next::fail);
  EXPECT_EQ(March().at(2000).next, Next::fail) << "there is no flow to return to";
}

TEST(SteadyControl, LeavesAGivenFlowThatLeadsNowhere) {
  March hopeless(true), proved(true), free_stream(false);
  EXPECT_EQ(hopeless.control.phase(), Phase::trial);
  for (int step = 0; step < 100; ++step) {
    EXPECT_EQ(hopeless.at(0.9 - 0.001 * step).next, Next::plain_step) << step;
    proved.at(0.9 - 0.005 * step);
    free_stream.at(0.9 - 0.001 * step);
  }
  const SteadyControl::Decision left = hopeless.at(0.8);
  EXPECT_EQ(left.next, Next::start_over);
  ASSERT_EQ(left.messages.size(), 1);
  EXPECT_NE(left.messages[0].find("given initial flow (residual 8.01e-01 at step 99)"), std::string::npos);
  EXPECT_EQ(hopeless.control.phase(), Phase::plain);
  EXPECT_EQ(proved.control.phase(), Phase::plain);
  EXPECT_EQ(proved.at(0.5).next, Next::plain_step);
  EXPECT_EQ(free_stream.at(0.8).next, Next::plain_step);
}

TEST(SteadyControl, LeavesAGivenFlowThatBlowsUpAgainAndAgain) {
  March march(true);
  march.at(0.9);
  for (int failure = 0; failure < 3; ++failure) EXPECT_EQ(march.at(2000).next, Next::return_to_best);
  EXPECT_EQ(march.at(2000).next, Next::start_over);
}

TEST(SteadyControl, LeavesAFlowThatHasLongNotHalvedToTimeWhereThatIsAsked) {
  March may(false, true), must_not(false, false);
  Next last = Next::plain_step;
  for (int step = 0; step < 502; ++step) {
    last = may.at(0.5 - 1e-4 * step).next;
    EXPECT_NE(must_not.at(0.5 - 1e-4 * step).next, Next::finish);
    EXPECT_EQ(last == Next::finish, step == 501) << step;
  }
}

}  // namespace
}  // namespace quadloop::flow::euler
