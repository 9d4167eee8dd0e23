// What a case says to the solver in its boundary tables.
#include "quadloop/case/solver_settings.hpp"

#include <gtest/gtest.h>

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
  const std::vector<BoundaryChoice> choices = euler_options(s.solver, s.outline.rules, mesh).boundaries;
  EXPECT_EQ(choices[0].temperature, 0.5);
  EXPECT_EQ(choices[1].temperature, 2);
  EXPECT_FALSE(choices[2].temperature);
  ASSERT_EQ(s.warnings.size(), 2U) << "of one each";
  EXPECT_NE(s.warnings[0].find("'boundary.b*.wall_temperature' does nothing"), std::string::npos);
  EXPECT_TRUE(
      read("[boundary.box]\nbc = \"wall\"\nwall_temperature = 2\n[solver]\nreynolds = 9\n").warnings.empty());
}

TEST_F(SolverSettingsTest, WarnsOfExitsIntoAVacuumBelowTheSpeedOfSound) {
  const std::string slow = "[solver]\nmach = 0.5\n", exit = "[boundary.box]\nbc = \"outflow\"\n";
  const Settings s = read(slow + exit);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("case.toml:5: [boundary.box] is an outflow without a pressure"),
            std::string::npos)
      << s.warnings[0];
  EXPECT_TRUE(read(slow + exit + "pressure = 1\n").warnings.empty());
  EXPECT_TRUE(read("[solver]\nmach = 2\n" + exit).warnings.empty());
  EXPECT_TRUE(read("[solver]\nkind = \"command\"\ncommand = [\"a\"]\n" + exit).warnings.empty());
  EXPECT_TRUE(read(exit).warnings.empty()) << "nobody is to solve";
}

}  // namespace
}  // namespace quadloop
