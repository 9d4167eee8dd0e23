// What [solver] says of goals.
#include "quadloop/case/goal_settings.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "quadloop/case/settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class GoalSettingsTest : public ::testing::Test {
 protected:
  GoalSettingsTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n[solver]\n" + text),
                         {});
  }
  std::vector<flow::Goal> goals(const std::string& text) { return read(text).solver.euler.goals; }
  void expect_refused(const std::string& text, const std::string& part) {
    const std::string said = test::refusal(folder_, [&] { read(text); });
    EXPECT_NE(said.find(part), std::string::npos) << text << said;
    EXPECT_NE(said.find("case.toml:"), std::string::npos) << said;
  }

  test::InputFolder folder_;
};

TEST_F(GoalSettingsTest, AreAWordAListOrWeights) {
  EXPECT_TRUE(goals("mach = 0.5\n").empty());
  const auto one = goals("goal = \"drag\"\n");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].quantity, flow::Goal::Quantity::drag);
  EXPECT_EQ(one[0].weight, 1);
  const auto two =
      goals("goal = [\"moment\", \"pressure\"]\ngoal_on = [\"b*\", \"c\"]\ngoal_about = [0.25, -1]\n");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].quantity, flow::Goal::Quantity::moment);
  EXPECT_EQ(two[0].about, (Point{0.25, -1}));
  EXPECT_EQ(two[1].boundaries, (std::vector<std::string>{"b*", "c"}));
  const auto weighed = goals("goal = { drag = 15, lift = 2 }\n");
  ASSERT_EQ(weighed.size(), 2U);
  EXPECT_EQ(weighed[0].quantity, flow::Goal::Quantity::lift);
  EXPECT_EQ(weighed[0].weight, 2);
  EXPECT_EQ(weighed[1].weight, 15);
  EXPECT_FALSE(read("goal = \"lift\"\n").solver.euler.adjoint_fields);
  EXPECT_TRUE(read("goal = \"lift\"\ngoal_adjoint = \"write\"\n").solver.euler.adjoint_fields);
}

TEST_F(GoalSettingsTest, RefusesWhatHasNoMeaning) {
  expect_refused("goal = \"range\"\n", "must be one of: lift, drag, moment, pressure");
  expect_refused("goal = [\"lift\", \"lift\"]\n", "'lift' twice");
  expect_refused("goal = []\n", "is empty");
  expect_refused("goal = { lift = 0 }\n", "goal.lift");
  expect_refused("goal = { thrust = 1 }\n", "goal.thrust");
  expect_refused("goal_on = [\"box\"]\n", "needs goal");
  expect_refused("goal = \"lift\"\ngoal_about = [0, 0]\n", "add \"moment\"");
  expect_refused("goal = \"lift\"\ngoal_adjoint = \"show\"\n", "goal_adjoint");
}

TEST_F(GoalSettingsTest, RefusesFlowsWithoutAnAdjoint) {
  expect_refused("goal = \"lift\"\nkind = \"command\"\ncommand = [\"a\"]\n",
                 "adjoint of the built-in solver");
  expect_refused("goal = \"lift\"\nviscosity = 0.001\n", "without viscosity");
  expect_refused("goal = \"lift\"\nreynolds = 5000\n", "without viscosity");
  expect_refused("goal = \"lift\"\ntime = \"accurate\"\nend_time = 1\n", "steady");
  expect_refused("goal = \"lift\"\nfar_field = \"vortex\"\n", "far_field = \"uniform\"");
  expect_refused("goal = \"lift\"\nmach = 0\n", "needs mach > 0, but mach = 0");
}

TEST_F(GoalSettingsTest, PatternsBecomeNames) {
  const std::vector<flow::Goal> asked{{flow::Goal::Quantity::lift, {"slat_*", "flap"}},
                                      {flow::Goal::Quantity::drag}};
  const auto goals = goals_on(asked, {"main", "slat_a", "flap", "slat_b"});
  EXPECT_EQ(goals[0].boundaries, (std::vector<std::string>{"slat_a", "flap", "slat_b"}));
  EXPECT_TRUE(goals[1].boundaries.empty());
  EXPECT_THROW(goals_on(asked, {"main", "flap"}), InputError);
}

}  // namespace
}  // namespace quadloop
