#include "quadloop/case/smooth_settings.hpp"

#include <gtest/gtest.h>

#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class SmoothSettingsTest : public ::testing::Test {
 protected:
  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"none.geom\"\n" + text), {});
  }
  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { read(text); });
  }

  test::InputFolder folder_;
};

TEST_F(SmoothSettingsTest, WithoutTheTableShapesAreIdeal) {
  EXPECT_FALSE(read("").stretch);
  EXPECT_FALSE(read("[smooth]\ntargets = \"ideal\"\n").stretch);
  const Settings thesis = read("[smooth]\nsweeps = 3\nobjective = \"thesis\"\nmethod = \"nlopt\"\n");
  EXPECT_EQ(thesis.smooth.sweeps, 3);
  EXPECT_EQ(thesis.smooth.objective, smoother::Objective::thesis);
  EXPECT_EQ(thesis.smooth.method, smoother::Method::nlopt);
}

TEST_F(SmoothSettingsTest, TargetsOfASolutionStretchCells) {
  EXPECT_EQ(read("[smooth]\ntargets = \"solution\"\n").stretch, 8.0);
  EXPECT_EQ(read("[smooth]\ntargets = \"solution\"\nstretch = 3\n").stretch, 3.0);
  EXPECT_EQ(read("[smooth]\ntargets = \"solution\"\n[adapt]\nvariable = [\"a\", \"b\"]\n").stretch, 8.0);
}

TEST_F(SmoothSettingsTest, TargetsAreRefusedWhereTheyCannotBe) {
  const std::string targets = "[smooth]\ntargets = \"solution\"\n";
  EXPECT_NE(refused("[smooth]\nstretch = 3\n").find("'smooth.stretch'"), std::string::npos);
  EXPECT_NE(refused("[mesh]\ntype = \"metric\"\n" + targets).find("'smooth.targets'"), std::string::npos);
  EXPECT_NE(refused("[mesh]\nquads = \"parallel\"\n" + targets).find("'smooth.targets'"), std::string::npos);
  EXPECT_NE(refused(targets + "sweeps = 0\n").find("'smooth.targets'"), std::string::npos);
  EXPECT_NE(refused(targets + "[adapt]\nvariable = { error = \"e\" }\nnorm = 1\nmax_nodes = 9\n")
                .find("'smooth.targets'"),
            std::string::npos);
}

}  // namespace
}  // namespace quadloop
