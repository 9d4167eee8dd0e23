// What a case says of adaptation, of its solver and of its own geometry.
#include "quadloop/case/adapt_settings.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "quadloop/case/case_input.hpp"
#include "quadloop/case/solver_settings.hpp"
#include "tests/io/input/temporary_file.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using adapt::AdaptOptions;

struct Case : testing::Test {
  Case() { folder.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }
  std::optional<AdaptOptions> adapt(const std::string& text) const {
    return read_adapt_table(io::read_case(folder.write("case.toml", text)));
  }
  std::string refused(const std::string& text) const {
    return test::refusal(folder, [&] { adapt("[adapt]\n" + text); });
  }
  std::string case_file(const std::string& more = "") const {
    return folder.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + more);
  }
  static CaseInput loaded(const CaseArguments& arguments) {
    Warnings not_looked_at;
    return load_case(test::world(), arguments, not_looked_at);
  }
  test::InputFolder folder;
};

TEST_F(Case, WithoutATableThereIsNoAdaptation) {
  EXPECT_FALSE(adapt("[mesh]\ntype = \"hybrid\"\n").has_value());
}

TEST_F(Case, AnEmptyTableHasTheDefaults) {
  const AdaptOptions options = *adapt("[adapt]\n");  // as docs/reference/case-file.md has them
  EXPECT_EQ(options.cycles, 5);
  EXPECT_EQ(options.source, AdaptOptions::Source::variables);
  EXPECT_EQ(options.variables, std::vector<std::string>{"density"});
  EXPECT_EQ(options.indicator, adapt::Indicator::difference);
  EXPECT_EQ(options.threshold, AdaptOptions::Threshold::deviation);
  EXPECT_EQ(options.refine, 1.0);
  EXPECT_EQ(options.coarsen, 0.5);
  EXPECT_FALSE(options.max_nodes || options.min);
}

TEST_F(Case, ReadsWhatWantedSizesFollow) {
  const AdaptOptions options = *adapt(
      "[adapt]\nnorm = 2\nmax_nodes = 5000\ngrowth = 1.5\nuntil = { cl = 1e-3, cd = 1e-4, estimate = 0.1 "
      "}\n");
  EXPECT_EQ(options.norm, 2);
  EXPECT_EQ(options.growth, 1.5);
  EXPECT_EQ(options.threshold, AdaptOptions::Threshold::nodes);
  EXPECT_EQ(options.until.cl, 1e-3);
  EXPECT_EQ(options.until.cd, 1e-4);
  EXPECT_EQ(options.until.estimate, 0.1);
  const AdaptOptions by_flags = *adapt("[adapt]\nuntil = { cd = 1e-4 }\n");
  EXPECT_FALSE(by_flags.norm || by_flags.growth || by_flags.until.cl);
  EXPECT_TRUE(adapt("[adapt]\n")->until.empty());
}

TEST_F(Case, RefusesWhatWantedSizesDoNotFollow) {
  const auto expect = [&](const std::string& text, const std::string& key) {
    EXPECT_NE(refused(text).find("adapt." + key), std::string::npos) << text << refused(text);
  };
  expect("norm = 2\n", "norm");
  expect("norm = 0.5\nmax_nodes = 100\n", "norm");
  expect("norm = 2\nmax_nodes = 100\nrefine = 1\n", "refine");
  expect("norm = 2\nmax_nodes = 100\ncoarsen = 1\n", "coarsen");
  expect("norm = 2\nmax_nodes = 100\nthreshold = \"fraction\"\n", "threshold");
  expect("norm = 2\nmax_nodes = 100\nindicator = \"difference\"\n", "indicator");
  expect("norm = 2\nmax_nodes = 100\nvariable = { size = \"h\" }\n", "norm");
  EXPECT_EQ(adapt("[adapt]\nnorm = 1\nmax_nodes = 100\nvariable = { error = \"e\" }\n")->source,
            AdaptOptions::Source::error);
  expect("growth = 2\n", "growth");
  expect("norm = 2\nmax_nodes = 100\ngrowth = 1\n", "growth");
  expect("until = {}\n", "until");
  expect("until = { cm = 1 }\n", "until.cm");
  expect("until = { cl = 0 }\n", "until.cl");
  expect("until = { estimate = 0.1 }\n", "until");
}

TEST_F(Case, ReadsEveryKeyOfAdaptation) {
  const AdaptOptions options = *adapt(
      "[adapt]\ncycles = 3\nvariable = [\"density\", \"pressure\"]\nindicator = \"hessian\"\nthreshold = "
      "\"nodes\"\n"
      "refine = 2\ncoarsen = -1\nmax_nodes = 5000\nmin = 0.01\n");
  EXPECT_EQ(options.cycles, 3);
  EXPECT_EQ(options.source, AdaptOptions::Source::variables);
  EXPECT_EQ(options.variables, (std::vector<std::string>{"density", "pressure"}));
  EXPECT_EQ(options.indicator, adapt::Indicator::hessian);
  EXPECT_EQ(options.threshold, AdaptOptions::Threshold::nodes);
  EXPECT_EQ(options.refine, 2);
  EXPECT_EQ(options.coarsen, -1);
  EXPECT_EQ(options.max_nodes, 5000);
  EXPECT_EQ(options.min, 0.01);
}

TEST_F(Case, AVariableMayBeASizeOrAnError) {
  const AdaptOptions size = *adapt("[adapt]\nvariable = { size = \"h\" }\n"),
                     error = *adapt("[adapt]\nvariable = { error = \"e\" }\n");
  EXPECT_EQ(size.source, AdaptOptions::Source::size);
  EXPECT_EQ(size.variables, (std::vector<std::string>{"h"}));
  EXPECT_EQ(error.source, AdaptOptions::Source::error);
  EXPECT_EQ(error.variables, (std::vector<std::string>{"e"}));
  for (const char* wrong : {"variable = { }\n", "variable = { size = \"h\", error = \"e\" }\n",
                            "variable = []\n", "variable = { sise = \"h\" }\n"})
    EXPECT_TRUE(refused(wrong).starts_with("case.toml:2: ")) << wrong << refused(wrong);
}

TEST_F(Case, SharesHaveDefaultsAndLimitsOfTheirOwn) {
  const AdaptOptions shares = *adapt("[adapt]\nthreshold = \"fraction\"\n");
  EXPECT_EQ(shares.refine, 0.2);
  EXPECT_EQ(shares.coarsen, 0.1);
  EXPECT_EQ(adapt("[adapt]\nthreshold = \"fraction\"\nrefine = 0.5\ncoarsen = 0.5\n")->coarsen, 0.5);
  EXPECT_NE(refused("threshold = \"fraction\"\nrefine = 0.6\ncoarsen = 0.5\n").find("must be 1 at most"),
            std::string::npos);
  EXPECT_NE(refused("threshold = \"fraction\"\nrefine = 2\n"), "");
}

TEST_F(Case, ContradictionsAreRefused) {
  EXPECT_NE(refused("refine = 0.5\ncoarsen = -0.6\n").find("make it larger than -refine"), std::string::npos);
  EXPECT_NE(refused("threshold = \"nodes\"\n").find("needs max_nodes; it is the number of nodes to reach"),
            std::string::npos);
  EXPECT_NE(refused("max_nodes = 10.5\n").find("must be a whole number, not 10.5"), std::string::npos);
  EXPECT_NE(refused("cycles = 1.5\n").find("must be a whole number"), std::string::npos);
  EXPECT_NE(refused("min = 0\n"), "");
  EXPECT_NE(refused("cycle = 3\n").find("unknown key 'adapt.cycle'"), std::string::npos);
}

Mesh with_boundaries(const std::vector<std::string>& names) {
  Mesh mesh;
  for (const std::string& name : names) mesh.boundaries.push_back({name, "none", {}});
  return mesh;
}

TEST_F(Case, OfPressuresExactNamesWinOverPatternsAndLaterOverEarlier) {
  SolverSettings settings;
  settings.pressures = {{"outlet_a", 0.9}, {"outlet_*", 0.5}, {"*", 0.1}};
  const auto choices =
      euler_options(settings, {}, with_boundaries({"outlet_a", "outlet_b", "wall"})).boundaries;
  ASSERT_EQ(choices.size(), 3U);
  EXPECT_EQ(choices[0].pressure, 0.9);
  EXPECT_EQ(choices[1].pressure, 0.1);
  EXPECT_EQ(choices[2].pressure, 0.1);
  EXPECT_EQ(choices[2].condition, BoundaryCondition::none) << "the mesh's own";
}

TEST_F(Case, RulesThatFindNothingInAMeshAreNoFault) {
  BoundaryRule wall{"wall*", {}, {}, BoundaryCondition::wall, "case.toml:3"},
      gone{"island", {}, {}, BoundaryCondition::wall, "case.toml:4"};
  const auto choices = euler_options({}, {wall, gone}, with_boundaries({"wall_1", "far"})).boundaries;
  EXPECT_EQ(choices.at(0).condition, BoundaryCondition::wall);
  EXPECT_EQ(choices.at(1).condition, BoundaryCondition::none);
}

TEST_F(Case, TheBuiltInSolverWritesItsVariablesAlone) {
  SolverSettings euler, command;
  command.kind = SolverSettings::Kind::command;
  EXPECT_NO_THROW(require_known_variables(euler, {"density", "pressure"}, "case.toml"));
  EXPECT_NO_THROW(require_known_variables(command, {"entropy"}, "case.toml"));
  EXPECT_THROW(require_known_variables(euler, {"density", "entropy"}, "case.toml"), InputError);
  EXPECT_THROW(require_known_variables(euler, {"error"}, "case.toml"), InputError) << "of what?";
  euler.euler.goals = {{flow::Goal::Quantity::drag}};
  EXPECT_NO_THROW(require_known_variables(euler, {"error"}, "case.toml"));
}

TEST_F(Case, TheSolverIsTheOneThatIsChosen) {
  const CaseInput input =
      loaded({case_file("[boundary.box]\nbc = \"wall\"\n[solver]\nmach = 2\ngamma = 1.3\n"), {}, "", {}});
  SolverSettings settings = input.settings.solver;
  const Geometry& geometry = input.mesh->geometry;
  const adapt::ChosenSolver euler =
      chosen_solver(settings, input.settings.outline.rules, geometry, "somewhere/case.toml");
  EXPECT_EQ(std::get<flow::EulerOptions>(euler).mach, 2);
  EXPECT_EQ(std::get<flow::EulerOptions>(euler).boundaries.at(0).condition, BoundaryCondition::wall);
  settings.kind = SolverSettings::Kind::command;
  const auto command =
      std::get<adapt::CommandSolver>(chosen_solver(settings, {}, geometry, "somewhere/case.toml"));
  EXPECT_EQ(command.gamma, 1.3);
  EXPECT_TRUE(command.case_folder.starts_with("/") && command.case_folder.ends_with("/somewhere"));
}

TEST_F(Case, AnOutlineIsNoCaseFile) {
  const std::string refusal = test::refusal(folder, [&] {
    loaded({(folder.path() / "box.geom").string(), {}, "", {}});
  });
  EXPECT_NE(refusal.find("is an outline, not a case file"), std::string::npos) << refusal;
}

TEST_F(Case, AnotherOutlineTakesThePlaceOfTheCases) {
  const std::string other = folder.write("other.geom", "1\nbox\n3\n0 0\n2 0\n0 2\n");
  const CaseInput input = loaded({case_file("scale = 2\n"), {"spacing.min=0.125"}, other, {}});
  EXPECT_EQ(input.mesh->geometry.size(), 3);
  EXPECT_EQ(input.mesh->geometry.box().high.x, 4) << "placed as the case's own";
  EXPECT_EQ(input.mesh->mesh.size.min, 0.125);
  EXPECT_NE(input.mesh->digest,
            loaded({case_file("scale = 2\n"), {"spacing.min=0.25"}, other, {}}).mesh->digest);
}

TEST_F(Case, AFarFieldOfTheOutlinesOwnIsTaken) {
  const std::string case_path = case_file("far_field = 10\n");
  const std::string other =
      folder.write("other.geom", "2\nfarfield\n4\n-9 -9\n9 -9\n9 9\n-9 9\nwall\n4\n0 0\n1 0\n1 1\n0 1\n");
  EXPECT_EQ(loaded({case_path, {}, other, {}}).mesh->geometry.box().high.x, 9);
  EXPECT_GT(loaded({case_path, {}, "", {}}).mesh->geometry.box().high.x, 9);
}

TEST_F(Case, TheRootOfASavedTreeStays) {
  TreeAttributes saved;
  saved.root_x = saved.root_y = -2;
  saved.tree_edge = 8;
  const CaseInput input = loaded({case_file(), {}, "", saved});
  ASSERT_TRUE(input.mesh->mesh.size.root.has_value());
  EXPECT_EQ(input.mesh->mesh.size.root->corner, (Point{-2, -2}));
  saved.tree_edge = 3;
  EXPECT_THROW(loaded({case_file(), {}, "", saved}), InputError);
}

TEST(MeshLimit, IsTheCellsAllowedOrTheMemoryThatIsFree) {
  EXPECT_EQ(mesh_limit(test::world(), 1000.0).cells, 1000);
  EXPECT_EQ(mesh_limit(test::world(), 1000.0).bytes, MeshLimit::none);
  EXPECT_EQ(mesh_limit(test::world(), {}).cells, MeshLimit::none);
  EXPECT_GT(mesh_limit(test::world(), {}).bytes, 1e6);
}

}  // namespace
}  // namespace quadloop
