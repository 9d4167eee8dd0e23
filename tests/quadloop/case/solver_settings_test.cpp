// What a case says to the solver in its boundary tables.
#include "quadloop/case/solver_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "quadloop/case/settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class SolverSettingsTest : public ::testing::Test {
 protected:
  SolverSettingsTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + text), {});
  }

  test::InputFolder folder_;
};

TEST_F(SolverSettingsTest, WallsMayHaveATemperature) {
  const Settings s = read(
      "[boundary.\"b*\"]\nbc = \"wall\"\nwall_temperature = 2\n[boundary.box]\nbc = \"wall\"\n"
      "wall_temperature = 0.5\n");
  Mesh mesh;
  mesh.boundaries = {{"box", "none", {}}, {"bottom", "none", {}}, {"other", "wall", {}}};
  const std::vector<flow::BoundaryChoice> choices = euler_options(s.solver, s.outline.rules, mesh).boundaries;
  EXPECT_EQ(choices[0].temperature, 0.5);
  EXPECT_EQ(choices[1].temperature, 2);
  EXPECT_FALSE(choices[2].temperature);
  ASSERT_EQ(s.warnings.size(), 2U) << "of one each";
  EXPECT_NE(s.warnings[0].find("'boundary.b*.wall_temperature' does nothing"), std::string::npos);
  EXPECT_TRUE(
      read("[boundary.box]\nbc = \"wall\"\nwall_temperature = 2\n[solver]\nreynolds = 9\n").warnings.empty());
}

TEST_F(SolverSettingsTest, AStreamAtRestNeedsSomethingThatDrivesTheFlow) {
  const std::string rest = "[solver]\nmach = 0\n",
                    warm = "[boundary.box]\nbc = \"wall\"\nwall_temperature = 2\n";
  const auto fault = [&](const std::string& text) { return test::refusal(folder_, [&] { read(text); }); };
  EXPECT_NE(fault(rest).find("'solver.mach' is 0, so nothing moves the gas"), std::string::npos)
      << fault(rest);
  EXPECT_NE(fault(rest + warm).find("is 0, so nothing"), std::string::npos) << "without viscosity";
  for (const std::string& text : {rest + "initial = \"vortex\"\n", rest + "viscosity = 0.1\n" + warm,
                                  rest + "[boundary.box]\nbc = \"outflow\"\npressure = 0.5\n"}) {
    const std::vector<std::string> warnings = read(text).warnings;
    EXPECT_TRUE(std::ranges::any_of(warnings, [](const auto& w) {
      return w.starts_with("solver.mach is 0");
    })) << text;
  }
  EXPECT_NO_THROW(read("[solver]\nkind = \"command\"\ncommand = [\"a\"]\nmach = 0\n"));
}

TEST_F(SolverSettingsTest, WarnsOfExitsIntoAVacuumBelowTheSpeedOfSound) {
  const std::string slow = "[solver]\nmach = 0.5\n", exit = "[boundary.box]\nbc = \"outflow\"\n";
  const Settings s = read(slow + exit);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("case.toml:5: [boundary.box] is a subsonic outflow without back pressure"),
            std::string::npos)
      << s.warnings[0];
  EXPECT_TRUE(read(slow + exit + "pressure = 1\n").warnings.empty());
  EXPECT_TRUE(read("[solver]\nmach = 2\n" + exit).warnings.empty());
  EXPECT_TRUE(read("[solver]\nkind = \"command\"\ncommand = [\"a\"]\n" + exit).warnings.empty());
  EXPECT_TRUE(read(exit).warnings.empty()) << "nobody is to solve";
}

TEST_F(SolverSettingsTest, WarnsOfKeysThatTheKindOfSolverDoesNotUse) {
  const Settings s =
      read("[solver]\nkind = \"command\"\ncommand = [\"a\"]\nmach = 0.5\ngamma = 1.3\ntimeout = 5\n");
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_TRUE(
      s.warnings[0].ends_with("case.toml:6: 'solver.mach' does nothing: it needs kind = \"euler\", but "
                              "kind = \"command\""))
      << s.warnings[0];
  EXPECT_EQ(read("[solver]\ntimeout = 5\n").warnings.size(), 1U);
}

}  // namespace
}  // namespace quadloop
