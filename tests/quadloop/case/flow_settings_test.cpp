// The table [flow]: the free stream of a solver of the user's.
#include "quadloop/case/flow_settings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "quadloop/case/settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class FlowSettingsTest : public ::testing::Test {
 protected:
  FlowSettingsTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + text), {});
  }
  void expect_refused(const std::string& text, const std::string& part) {
    const std::string said = test::refusal(folder_, [&] { read(text); });
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }

  test::InputFolder folder_;
};

const std::string command = "[solver]\nkind = \"command\"\ncommand = [\"a\"]\n";

TEST_F(FlowSettingsTest, TellsTheFreeStreamOfASolverOfTheUsers) {
  const auto stream = read(command +
                           "[flow]\npressure = 5\ndensity = 2\nspeed = 3\nalpha = 4\ngamma = 1.6\n"
                           "reference_length = 7\nreynolds = 6\n")
                          .stream;
  ASSERT_TRUE(stream);
  EXPECT_EQ(stream->pressure, 5);
  EXPECT_EQ(stream->density, 2);
  EXPECT_EQ(stream->speed, 3);
  EXPECT_EQ(stream->alpha, 4);
  EXPECT_EQ(stream->gamma, 1.6);
  EXPECT_EQ(stream->reference_length, 7);
  EXPECT_EQ(stream->viscosity, 2.0 * 3 * 7 / 6);
  const Settings plain = read(command + "[flow]\npressure = 0\n");
  EXPECT_TRUE(plain.warnings.empty());
  ASSERT_TRUE(plain.stream);
  EXPECT_EQ(plain.stream->speed, 1);
  EXPECT_EQ(plain.stream->viscosity, 0) << "no friction without a Reynolds number";
}

TEST_F(FlowSettingsTest, IsNoneWithoutAPressureAndForTheBuiltInSolver) {
  EXPECT_FALSE(read(command + "[flow]\nreynolds = 1e6\n").stream);
  EXPECT_FALSE(read(command).stream);
  const Settings built_in = read("[flow]\npressure = 1\n");
  EXPECT_FALSE(built_in.stream);
  ASSERT_EQ(built_in.warnings.size(), 1U);
  EXPECT_NE(built_in.warnings[0].find("[flow] does nothing"), std::string::npos) << built_in.warnings[0];
}

TEST_F(FlowSettingsTest, AMachNumberDecidesTheSpeed) {
  const std::string gas = command + "[flow]\nreynolds = 5e3\npressure = 2.5\ndensity = 1.4\nmach = 0.5\n";
  const double sound = std::sqrt(1.4 * 2.5 / 1.4);
  EXPECT_DOUBLE_EQ(read(gas).stream->speed, 0.5 * sound);
  EXPECT_DOUBLE_EQ(read(gas).stream->viscosity, 1.4 * 0.5 * sound / 5e3);
  EXPECT_EQ(read(gas + "speed = 0.79\n").stream->speed, 0.79) << "they agree";
  EXPECT_EQ(read(command + "[flow]\nreynolds = 5e3\nmach = 0.5\n").flow->speed, 0.5);
  expect_refused(gas + "speed = 1\n",
                 "'flow.mach' is 0.5, but speed, density, pressure and gamma make 0.6325");
  expect_refused("[flow]\nreynolds = 5e3\nmach = 0.5\nspeed = 1\n", "'flow.mach' needs pressure or no speed");
  expect_refused("[flow]\npressure = 0\nmach = 0.5\n", "'flow.mach' needs pressure > 0 or no pressure");
}

TEST_F(FlowSettingsTest, RefusesWhatNoFlowHas) {
  expect_refused("[flow]\n", "'flow.reynolds' is missing");
  expect_refused("[flow]\npressure = 1\nreynolds = 0\n", "case.toml:5: 'flow.reynolds' is 0");
  expect_refused("[flow]\npressure = nan\n", "case.toml:4: 'flow.pressure'");
  expect_refused("[flow]\npressure = 1\ngamma = 1\n", "'flow.gamma' is 1");
  expect_refused("[flow]\npressure = 1\nalpha = 400\n", "'flow.alpha' is 400");
  const std::string layers = "[boundary.box]\nlayers = { first = \"yplus:1\", count = 3 }\n";
  expect_refused("[flow]\npressure = 1\nreynolds = 40\n" + layers,
                 "requires 'flow.reynolds' of at least 1000 for a y+; it is 40");
  expect_refused("[flow]\npressure = 1\n" + layers,
                 "requires 'flow.reynolds' of at least 1000 for a y+; it is missing");
}

}  // namespace
}  // namespace quadloop
