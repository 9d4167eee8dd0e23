#include <gtest/gtest.h>

#include <set>

#include "generate/digests.hpp"
#include "quadloop/case/settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

/// A diamond in a box, both their own images in the x axis; its two sides have names of their own.
class MirrorTest : public ::testing::Test {
 protected:
  MirrorTest() {
    folder_.write(
        "diamond.geom",
        "3\nbox\n4\n-4 -4\n4 -4\n4 4\n-4 4\nlower open\n3\n1 0\n0 -1\n-1 0\nupper open\n3\n-1 0\n0 1\n1 0\n");
  }

  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"diamond.geom\"\n" + text), {});
  }
  Geometry load(const std::string& text) {
    warnings_.clear();
    return load_geometry(read(text), warnings_);
  }
  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { load(text); });
  }

  test::InputFolder folder_;
  Warnings warnings_;
};

TEST_F(MirrorTest, AMirrorIsTheMeshsAndTheSolvers) {
  const Settings settings = read("[mesh]\nmirror = \"y\"\n");
  EXPECT_EQ(settings.mesh.mirror, MirrorAxis::y);
  EXPECT_EQ(settings.solver.euler.mirror, MirrorAxis::y);
  EXPECT_FALSE(settings.half);
  MeshOptions across = settings.mesh, without = settings.mesh;
  across.mirror = MirrorAxis::x;
  without.mirror.reset();
  EXPECT_NE(case_digest(settings.mesh), case_digest(across));
  EXPECT_NE(case_digest(settings.mesh), case_digest(without));
}

TEST_F(MirrorTest, WantsLinesMirroredWhereTheMeshIs) {
  const auto line = [](const std::string& path, const std::string& spacing = "0.1") {
    return "[[layer_line]]\npath = " + path + "\nspacing = " + spacing + "\nfirst = 1e-3\ncount = 5\n";
  };
  const std::string mirror = "[mesh]\nmirror = \"x\"\n", above = line("[[1, 0.5], [2, 1]]");
  EXPECT_EQ(read(mirror + line("[[2, 0], [3, 0]]")).lines.size(), 1U);
  EXPECT_EQ(read(mirror + above + line("[[1, -0.5], [2, -1]]")).lines.size(), 2U);
  EXPECT_EQ(read(mirror + "[[wake]]\nfrom = \"box\"\nlength = 3\nspacing = 0.1\n").lines.size(), 1U);
  EXPECT_EQ(read(above + "[mesh]\nmirror = \"x\"\nhalf = \"axis\"\n").lines.size(), 1U);
  const std::string lacks = "case.toml:5: this [[layer_line]] has no mirror image in the x-axis";
  EXPECT_NE(refused(mirror + above).find("path = [[1, -0.5], [2, -1]]"), std::string::npos);
  for (const std::string& other : {line("[[2, -1], [1, -0.5]]"), line("[[1, -0.5], [2, -1]]", "0.2")})
    EXPECT_TRUE(refused(mirror + above + other).starts_with(lacks)) << other;
  for (const char* across : {"[[1, -0.5], [1, 0.4]]", "[[1, -0.5], [2, 0.5]]", "[[1, 0], [2, 1]]"})
    EXPECT_NE(refused(mirror + line(across)).find("case.toml:5: this [[layer_line]] reaches the x-axis but"),
              std::string::npos)
        << across;
  for (const char* reaching : {"[[1, 0], [2, 0]]", "[[1, -1], [1, 1]]", "[[1, 0], [1, 1]]"})
    EXPECT_NE(refused(mirror + "half = \"axis\"\n" + line(reaching))
                  .find("case.toml:6: this [[layer_line]] reaches"),
              std::string::npos)
        << reaching;
  const Settings across = read(mirror + line("[[1, -0.5], [2, 0], [1, 0.5]]"));
  EXPECT_EQ(across.lines.at(0).across, MirrorAxis::x);
  EXPECT_FALSE(read(line("[[1, -0.5], [2, 0], [1, 0.5]]")).lines.at(0).across);
}

TEST_F(MirrorTest, OfAHalfNoMirrorIsLeft) {
  const Settings settings = read("[mesh]\nmirror = \"x\"\nhalf = \"middle\"\n");
  EXPECT_FALSE(settings.mesh.mirror);
  ASSERT_TRUE(settings.half);
  EXPECT_EQ(settings.half->axis, MirrorAxis::x);
  EXPECT_EQ(settings.half->boundary, "middle");
  EXPECT_EQ(refused("[mesh]\nhalf = \"middle\"\n").find("case.toml:4: 'mesh.half' needs mirror"), 0u);
}

TEST_F(MirrorTest, TablesOfTheDroppedSideMayStay) {
  const std::string both =
      "[spacing]\nmin = 0.1\nmax = 1\n[mesh]\nmirror = \"x\"\nhalf = \"middle\"\n[boundary.lower]\nspacing = "
      "0.2\n"
      "[boundary.upper]\nspacing = 0.2\n";
  const Geometry half = load(both);
  std::set<std::string> names;
  for (const Boundary& boundary : half.boundaries()) names.insert(boundary.name);
  EXPECT_EQ(names, (std::set<std::string>{"box", "middle", "upper"}));
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  EXPECT_NE(refused(both + "[boundary.uper]\nspacing = 0.2\n").find("matches 'uper'"), std::string::npos);
  EXPECT_NE(refused(both + "[boundary.midle]\nspacing = 0.2\n")
                .find("it has: box, lower, upper, middle; do you mean 'middle'?"),
            std::string::npos);
}

TEST_F(MirrorTest, AConditionThatTheImageHasNotIsToldOf) {
  const std::string half = "[spacing]\nmin = 0.1\nmax = 1\n[mesh]\nmirror = \"x\"\nhalf = \"middle\"\n";
  load(half + "[boundary.lower]\nbc = \"farfield\"\n[boundary.upper]\nbc = \"wall\"\n");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("'lower' (bc farfield) is in the half left out"), std::string::npos)
      << warnings_[0];
}

}  // namespace
}  // namespace quadloop
