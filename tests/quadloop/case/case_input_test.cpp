// The input of a case on several ranks: the first one reads its geometry, all have it, or its error.
#include "quadloop/case/case_input.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// Boxes from (0, 0) to (4, 4).
class CaseInputTest : public ::testing::Test {
 protected:
  CaseInputTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  CaseInput load(const std::string& text) {
    warnings_.clear();
    return load_case(world(), {{folder_.file("case.toml"), text}, {}, {}, {}}, warnings_);
  }
  std::string refused(const std::string& text) {
    return test::refusal_text([&] { load(text); });
  }
  /// Whether all ranks have the same words.
  static bool is_the_same(const std::vector<std::string>& words) {
    return !world().any(words != broadcast_words(world(), words));
  }

  test::TemporaryFolder folder_;
  Warnings warnings_;
};

TEST_F(CaseInputTest, OnlyTheFirstRankReadsTheGeometry) {
  const std::string file = world().is_root() ? "box.geom" : "no_such_file.geom";
  const CaseInput input = load("[geometry]\nfile = \"" + file + "\"\n[spacing]\nmax = 2.0\n");
  EXPECT_EQ(input.mesh->geometry.size(), 4);
  EXPECT_EQ(input.mesh->geometry.point(2), (Point{4, 4}));
  EXPECT_EQ(input.mesh->mesh.size.max, 2);
  EXPECT_EQ(input.mesh->mesh.size.min, 1);
  EXPECT_EQ(input.extents.size(), world().is_root() ? 1u : 0u);
}

TEST_F(CaseInputTest, AllRanksHaveItsErrors) {
  folder_.write("torn.geom", "1\nbox\n4\n0 0\n4 0\n4 x\n0 4\n");
  folder_.write("crossed.geom", "1\nbox\n4\n0 0\n4 0\n0 4\n4 5\n");
  for (const char* file : {"torn.geom", "crossed.geom", "missing.geom"}) {
    const std::string text = refused(std::string("[geometry]\nfile = \"") + file + "\"\n");
    EXPECT_NE(text.find(file), std::string::npos) << text;
    EXPECT_TRUE(is_the_same({text}));
  }
}

TEST_F(CaseInputTest, AllRanksHaveItsWarningsAndFormats) {
  folder_.write("twice.geom", "1\nbox\n5\n0 0\n4 0\n4 0\n4 4\n0 4\n");
  const CaseInput input = load(
      "[geometry]\nfile = \"twice.geom\"\n[spacing]\nmin = 0.5\n[boundary.box]\nspacing = 0.1\n"
      "[output]\npartitions = 2\nformats = [\"mesh\"]\n");
  EXPECT_GE(warnings_.size(), 2u) << "of the point that is there twice, and of the spacing";
  EXPECT_TRUE(is_the_same(warnings_));
  EXPECT_EQ(input.part_formats, std::vector<std::string>{"mesh"});
}

TEST_F(CaseInputTest, SizesOfBlocksAreKnownToAllRanks) {
  const CaseInput input = load(
      "[geometry]\nfile = \"box.geom\"\n[spacing]\nmax = 1.0\n[[block]]\nname = \"gas\"\nboundaries = "
      "[\"box\"]\n"
      "spacing = 0.25\n");
  ASSERT_EQ(input.mesh->mesh.size.sources.size(), 1u);
  EXPECT_EQ(input.mesh->mesh.size.sources.front().spacing, 0.25);
  EXPECT_EQ(input.mesh->mesh.size.min, 0.125);
  EXPECT_TRUE(is_the_same({std::to_string(input.mesh->digest)}));
}

}  // namespace
}  // namespace quadloop
