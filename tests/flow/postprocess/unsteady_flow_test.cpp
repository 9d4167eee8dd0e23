// What forces did over time: means, extremes, the period where there is one.
#include "flow/postprocess/unsteady_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadloop::flow {
namespace {

/// Rows from time 0 on whose lift is `lift(time)` and whose drag is 0.5 throughout, after two steady ones.
template <class Lift>
std::vector<HistoryRow> history(const Lift& lift, double end, double step) {
  std::vector<HistoryRow> rows{{0, 1, 9, 9, 0}, {1, 0.5, -9, 9, 0}};
  const int count = static_cast<int>(std::lround(end / step));
  for (int k = 0; k <= count; ++k) rows.push_back({k, 0.1, lift(step * k), 0.5, step * k});
  return rows;
}

double sine(double time) { return 0.2 + 0.3 * std::sin(2 * std::numbers::pi * time / 1.7); }

TEST(UnsteadyFlow, TellsMeanExtremesAndPeriod) {
  const UnsteadyFlow flow = unsteady_flow(history(sine, 8.5, 0.01), 1.7);
  EXPECT_NEAR(flow.from, 1.7, 1e-12);
  EXPECT_NEAR(flow.to, 8.5, 1e-12);
  EXPECT_NEAR(flow.cl.mean, 0.2, 1e-5);
  EXPECT_NEAR(flow.cl.smallest, -0.1, 1e-4);
  EXPECT_NEAR(flow.cl.largest, 0.5, 1e-4);
  EXPECT_EQ(flow.cd.mean, 0.5);
  ASSERT_TRUE(flow.period);
  EXPECT_NEAR(*flow.period, 1.7, 1e-4);
}

TEST(UnsteadyFlow, LeavesOutWhatWasSteady) {
  const UnsteadyFlow flow = unsteady_flow(history(sine, 8.5, 0.01), 0);
  EXPECT_LT(flow.cl.largest, 1);  // the steady rows have 9 and -9
  EXPECT_GT(flow.cl.smallest, -1);
}

TEST(UnsteadyFlow, SeesNoPeriodWhereThereIsNone) {
  const auto drifting = [](double time) { return 0.1 * time; };
  EXPECT_FALSE(unsteady_flow(history(drifting, 8, 0.01), 0).period);
  const auto twice = [](double time) { return std::sin(2 * std::numbers::pi * time / 4); };
  EXPECT_FALSE(unsteady_flow(history(twice, 8, 0.01), 0).period);  // goes up through its mean once
  const auto ever_faster = [](double time) { return std::sin(time * time); };
  EXPECT_FALSE(unsteady_flow(history(ever_faster, 8, 0.01), 0).period);
  const auto still = [](double) { return 0.3; };
  EXPECT_FALSE(unsteady_flow(history(still, 8, 0.01), 0).period);
}

TEST(UnsteadyFlow, RipplesAreNoPeriod) {
  const auto rippled = [](double time) { return sine(time) + 0.02 * std::sin(60 * time); };
  const UnsteadyFlow flow = unsteady_flow(history(rippled, 8.5, 0.01), 0);
  ASSERT_TRUE(flow.period);
  EXPECT_NEAR(*flow.period, 1.7, 0.05);
}

TEST(UnsteadyFlow, IsOneLine) {
  UnsteadyFlow flow = unsteady_flow(history(sine, 8.5, 0.01), 1.7);
  const auto begins = [&flow](const char* words) {
    EXPECT_TRUE(line_of(flow).starts_with(words)) << line_of(flow);
  };
  flow.steps = 850;
  begins("solved in 850 explicit steps to time 8.5; means from time 1.7 on");
  flow.continued = true;
  flow.steps = flow.unsolved = 1;
  flow.implicit = true;
  begins("continued in 1 implicit step to time 8.5; means from time 1.7 on");
  EXPECT_NE(line_of(flow).find("; 1 of them did not converge to the tolerance"), std::string::npos);
  flow.steady_steps = 100;
  flow.steady_residual = 1e-3;
  begins("the residual fell by 3.0 orders in 100 steps: the flow is classified as unsteady; continued in 1");
  flow.steady_residual = 2;
  begins("the residual rose by 0.3 orders in 100 steps: ");
  flow.steady_residual = 1.01;
  flow.steady_steps = 1;
  begins("the residual did not fall in 1 step: ");
}

}  // namespace
}  // namespace quadloop::flow
