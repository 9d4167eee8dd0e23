// Tables [[block]], and single points: what they describe, what they exclude, conditions and layers between
// blocks.
#include <gtest/gtest.h>

#include "tests/quadloop/case/settings_fixture.hpp"

namespace quadloop {
namespace {

class BlockSettings : public test::SettingsFixture {};

TEST_F(BlockSettings, ReadsBlocksAndRefusesWhatTheyDoNotGoWith) {
  const std::string gas = "[[block]]\nname = \"gas\"\nboundaries = [\"box\", \"-hole\"]\n";
  const Settings settings = read(gas + "[[block]]\nname = \"solid\"\ninside = [1, 2]\n");
  ASSERT_EQ(settings.outline.blocks.size(), 2U);
  EXPECT_EQ(settings.outline.blocks[0].boundaries, (std::vector<std::string>{"box", "hole"}));
  EXPECT_EQ(settings.outline.blocks[1].inside, (Point{1, 2}));
  EXPECT_EQ(refused("[[block]]\nname = \"gas\"\n").find("case.toml:3: a [[block]] needs exactly one"), 0u);
  EXPECT_EQ(refused(gas + "loop = \"box\"\n").find("case.toml:3: a [[block]] needs exactly one"), 0u);
  EXPECT_EQ(refused("[[block]]\nloop = \"box\"\n").find("case.toml:3: 'block.0.name' is missing"), 0u);
  EXPECT_EQ(refused("[[block]]\nname = \"a b\"\nloop = \"box\"\n").find("case.toml:4: 'block.0.name'"), 0u);
  const std::string start = "case.toml:3: a mesh of several blocks cannot have ";
  for (const auto& [more, what] : {std::pair{"[mesh]\nmirror = \"x\"\n", "mirror images"},
                                   {"[mesh]\nmirror = \"x\"\nhalf = \"axis\"\n", "mirror images"},
                                   {"[adapt]\nvariable = \"density\"\n", "the built-in solver"},
                                   {"[smooth]\ntargets = \"solution\"\n", "r-adaptation"}})
    EXPECT_EQ(refused(gas + more).find(start + what), 0u) << refused(gas + more);
}

TEST_F(BlockSettings, APathOfOnePointIsANode) {
  const std::string probe = "[[line]]\nname = \"probe\"\npath = [[1, 2]]\n";
  const Settings settings = read(probe);
  EXPECT_TRUE(settings.outline.lines.empty());
  ASSERT_EQ(settings.mesh.required_points.size(), 1U);
  EXPECT_EQ(settings.mesh.required_points[0].name, "probe");
  EXPECT_EQ(settings.mesh.required_points[0].position, (Point{1, 2}));
  EXPECT_EQ(refused(probe + "kind = \"baffle\"\n").find("case.toml:6: 'line.0.kind' is \"baffle\""), 0U);
  const std::string start = "case.toml:3: a mesh with single points as nodes cannot have ";
  for (const auto& [more, what] : {std::pair{"[mesh]\nmirror = \"x\"\n", "mirror images"},
                                   {"[design]\nmorph_to = 0.5\n", "morphing"},
                                   {"[output]\npartitions = 2\n", "partitions"}})
    EXPECT_EQ(refused(probe + more).find(start + what), 0U) << refused(probe + more);
}

TEST_F(BlockSettings, LayersAreInABlockBesideTheirBoundary) {
  const std::string layers = "[boundary.box]\nlayers = { first = 0.01, count = 2 }\nlayers_in = \"gsa\"\n";
  EXPECT_NE(refused(layers).find("the case has no [[block]]; remove this key"), std::string::npos);
  const std::string block = "[[block]]\nname = \"gas\"\nloop = \"box\"\n";
  const std::string said = refused(block + layers);
  EXPECT_NE(said.find("[boundary.box]: layers_in = \"gsa\": no block of this name is beside boundary 'box'; "
                      "name gas"),
            std::string::npos)
      << said;
}

/// A square of side 2 in the middle of the box, each a block.
const std::string core_in_box =
    "[[shape]]\nname = \"core\"\nkind = \"rectangle\"\nbox = [1, 3, 1, 3]\n"
    "[[block]]\nname = \"gas\"\nloop = \"box\"\n[[block]]\nname = \"solid\"\nloop = \"core\"\n";

TEST_F(BlockSettings, ConditionsThatNeedAnOutsideAreRefusedBetweenBlocks) {
  for (const std::string name : {"core", "\"co*\""}) {
    const std::string said = refused(core_in_box + "[boundary." + name + "]\nbc = \"inflow\"\n");
    EXPECT_EQ(said.find("case.toml:13: [boundary.co"), 0U) << said;
    EXPECT_NE(said.find("boundary 'core' lies between the blocks 'gas' and 'solid', where bc = \"inflow\" is "
                        "not possible; set bc = \"interface\" in [boundary.core]"),
              std::string::npos)
        << said;
  }
  load(read(core_in_box + "[boundary.\"*\"]\nbc = \"inflow\"\n[boundary.core]\nbc = \"interface\"\n"));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(BlockSettings, AWallBetweenBlocksIsPossibleWithAWarning) {
  load(read(core_in_box + "[boundary.box]\nbc = \"wall\"\n"));
  EXPECT_TRUE(warnings_.empty()) << "the outer boundary";
  const Geometry geometry = load(read(core_in_box + "[boundary.\"*\"]\nbc = \"wall\"\n"));
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_EQ(
      warnings_.front(),
      "boundary 'core' lies between the blocks 'gas' and 'solid': bc = \"wall\" makes it a wall in both; "
      "if it is none, set bc = \"interface\" in [boundary.core]");
  EXPECT_EQ(geometry.boundaries()[1].condition, BoundaryCondition::wall);
}

TEST_F(BlockSettings, ALineHasALength) {
  EXPECT_EQ(refused("[[line]]\nname = \"a\"\npath = [[1, 1], [1, 1]]\n"),
            "case.toml:5: 'line.0.path' has no length: all its points are (1, 1); give two different points");
}

TEST_F(BlockSettings, ASplineOfALineNeedsAPath) {
  EXPECT_EQ(
      refused("[[line]]\nboundary = \"core\"\nspline = true\n"),
      "case.toml:5: 'line.0.spline' needs a path; the curves of boundary = \"core\" are those of its file or "
      "shape");
}

}  // namespace
}  // namespace quadloop
