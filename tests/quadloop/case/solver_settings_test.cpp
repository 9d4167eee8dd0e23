// What a case says to the solver, in its own table and in the boundary tables.
#include "quadloop/case/solver_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/quadloop/case/settings_fixture.hpp"

namespace quadloop {
namespace {

using flow::EulerOptions;

class SolverSettingsTest : public test::SettingsFixture {};

TEST_F(SolverSettingsTest, ReadsWhatFlowsInTimeAreToDo) {
  const EulerOptions usual = read("[solver]\nmach = 1\n").solver.euler;
  EXPECT_EQ(usual.unsteady, EulerOptions::Unsteady::stop);
  EXPECT_FALSE(usual.time_step || usual.average_from);
  const EulerOptions transferred =
      read("[solver]\nunsteady = \"carry_on\"\nflow_throughs = 7\ntime_step = 0.5\n").solver.euler;
  EXPECT_EQ(transferred.unsteady, EulerOptions::Unsteady::continue_in_time);
  EXPECT_EQ(transferred.flow_throughs, 7);
  EXPECT_EQ(transferred.time_step, 0.5);
  const EulerOptions timed =
      read("[solver]\ntime = \"accurate\"\nend_time = 9\naverage_from = 4\n").solver.euler;
  EXPECT_EQ(timed.average_from, 4);
  EXPECT_FALSE(timed.time_step);
}

TEST_F(SolverSettingsTest, ReadsTheSolver) {
  const Settings s = read(R"([solver]
kind = "command"
mach = 0.5
alpha = 2
gamma = 1.3
time = "accurate"
end_time = 3
cfl = 5
iterations = 7
tolerance = 1e-4
limiter = "none"
initial = "vortex"
far_field = "vortex"
reference_length = 2
ranks = 3
command = ["flow", "{mesh}"]
mesh = "m.mesh"
solution = "s.cgns"
timeout = 60
)");
  const EulerOptions& euler = s.solver.euler;
  EXPECT_EQ(euler.mach, 0.5);
  EXPECT_EQ(euler.alpha, 2);
  EXPECT_EQ(euler.gamma, 1.3);
  EXPECT_EQ(euler.far_field, EulerOptions::FarField::vortex);
  EXPECT_EQ(euler.time, EulerOptions::Time::accurate);
  EXPECT_EQ(euler.end_time, 3);
  EXPECT_EQ(euler.cfl, 5);
  EXPECT_EQ(euler.iterations, 7);
  EXPECT_EQ(euler.tolerance, 1e-4);
  EXPECT_EQ(euler.limiter, EulerOptions::Limiter::none);
  EXPECT_EQ(euler.initial, EulerOptions::Initial::vortex);
  EXPECT_EQ(euler.reference_length, 2);
  EXPECT_EQ(s.solver.kind, SolverSettings::Kind::command);
  EXPECT_EQ(s.solver.command.ranks, 3);
  EXPECT_EQ(s.solver.command.command.arguments, (std::vector<std::string>{"flow", "{mesh}"}));
  EXPECT_EQ(s.solver.command.mesh, "m.mesh");
  EXPECT_EQ(s.solver.command.solution, "s.cgns");
  EXPECT_EQ(s.solver.command.command.timeout, 60);
}

TEST_F(SolverSettingsTest, BoundaryTablesGiveTheMeshItsConditions) {
  const Settings s = read(
      "far_field = 10\n[boundary.\"b*\"]\nbc = \"outflow\"\npressure = 2\n[boundary.box]\nbc = "
      "\"outflow\"\npressure = 0.5\n");
  Mesh mesh;
  mesh.boundaries = {
      {"box", "none", {}}, {"bottom", "wall", {}}, {"farfield", "none", {}}, {"other", "symmetry", {}}};
  const std::vector<flow::BoundaryChoice> choices = euler_options(s.solver, s.outline.rules, mesh).boundaries;
  ASSERT_EQ(choices.size(), 4u);
  EXPECT_EQ(choices[0].condition, BoundaryCondition::outflow);
  EXPECT_EQ(choices[0].pressure, 0.5);
  EXPECT_EQ(choices[1].condition, BoundaryCondition::outflow);
  EXPECT_EQ(choices[1].pressure, 2);
  EXPECT_EQ(choices[2].condition, BoundaryCondition::farfield);
  EXPECT_EQ(choices[3].condition, BoundaryCondition::none);  // the mesh's own stands
  EXPECT_FALSE(choices[3].pressure);
}

TEST_F(SolverSettingsTest, AReynoldsNumberSetsTheViscosity) {
  const EulerOptions o = read("[solver]\nmach = 0.5\nreynolds = 5000\nreference_length = 2\n").solver.euler;
  EXPECT_EQ(o.viscosity, 0.5 * 2 / 5000);
  EXPECT_EQ(o.prandtl, 0.72);
  const EulerOptions given = read("[solver]\nviscosity = 0.25\nprandtl = 1\n").solver.euler;
  EXPECT_EQ(given.viscosity, 0.25);
  EXPECT_EQ(given.prandtl, 1);
  EXPECT_EQ(read("").solver.euler.viscosity, 0);
}

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
