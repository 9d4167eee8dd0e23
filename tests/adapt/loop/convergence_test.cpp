// When a run has settled, and at which order its estimate falls. On one rank alone.
#include "adapt/loop/convergence.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"

namespace quadloop::adapt {
namespace {

const CycleValues before{1000, 0.3, 0.02, 0.4};

TEST(Settling, NeedsAllThatIsNamedToChangeByLess) {
  const CycleValues now{1000, 0.3005, 0.0198, 0.39};
  EXPECT_FALSE(have_settled({}, before, now)) << "nothing is named";
  EXPECT_TRUE(have_settled({.cl = 1e-3}, before, now));
  EXPECT_FALSE(have_settled({.cl = 1e-4}, before, now));
  EXPECT_TRUE(have_settled({.cd = 3e-4}, before, now));
  EXPECT_FALSE(have_settled({.cl = 1e-3, .cd = 1e-4}, before, now));
  EXPECT_TRUE(have_settled({.estimate = 0.03}, before, now)) << "by a fortieth of what it was";
  EXPECT_FALSE(have_settled({.estimate = 0.02}, before, now));
  EXPECT_TRUE(have_settled({.cl = 1e-3, .cd = 3e-4, .estimate = 0.03}, before, now));
  EXPECT_FALSE(have_settled({.cl = 1}, {1000, {}, 0.02, {}}, now));
}

TEST(Settling, NeedsConvergedFlows) {
  CycleValues finished = before, unfinished = before;
  finished.converged = true;
  unfinished.converged = false;
  EXPECT_TRUE(have_settled({.cl = 1e-3}, finished, finished));
  EXPECT_FALSE(have_settled({.cl = 1e-3}, finished, unfinished));
  EXPECT_FALSE(have_settled({.cl = 1e-3}, unfinished, finished));
}

TEST(Settling, RefusesWhatTheSolverDoesNotTell) {
  EXPECT_NO_THROW(require_reported({.estimate = 1}, {}));
  EXPECT_NO_THROW(require_reported({.cl = 1, .cd = 1}, before));
  EXPECT_THROW(require_reported({.cl = 1}, {1000, {}, 0.02, {}}), InputError);
  EXPECT_THROW(require_reported({.cd = 1}, {1000, 0.3, {}, {}}), InputError);
}

TEST(Settling, TheOrderIsThatOfTheEdge) {
  EXPECT_DOUBLE_EQ(*observed_order(before, {4000, {}, {}, 0.1}), 2);
  EXPECT_DOUBLE_EQ(*observed_order(before, {4000, {}, {}, 0.2}), 1);
  EXPECT_FALSE(observed_order(before, {1050, {}, {}, 0.1})) << "as many nodes tell nothing";
  EXPECT_FALSE(observed_order(before, {4000, {}, {}, {}}));
  EXPECT_FALSE(observed_order(before, {4000, {}, {}, 0.0}));
}

TEST(Settling, ValuesComeBackFromTheRecord) {
  CycleRecord record;
  record.nodes = 1234;
  record.cl = 1.0 / 3;
  record.estimate = 1e-3 / 7;
  record.order = 2.25;
  record.settled = false;
  record.converged = false;
  record.log_residual = -4.5;
  const std::string text = json_text(record);
  const CycleValues values = recorded_values(text);
  EXPECT_EQ(values.nodes, 1234);
  EXPECT_EQ(values.cl, record.cl);
  EXPECT_FALSE(values.cd.has_value());
  EXPECT_EQ(values.estimate, record.estimate);
  EXPECT_EQ(values.converged, false);
  EXPECT_EQ(recorded_number(text, "order"), 2.25);
  EXPECT_EQ(recorded_number(text, "log_residual"), -4.5);
  EXPECT_NE(text.find("\n  \"settled\": false,"), std::string::npos) << text;
}

}  // namespace
}  // namespace quadloop::adapt
