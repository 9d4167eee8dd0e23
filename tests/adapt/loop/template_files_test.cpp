// The files of a user's case for SU2 or OpenFOAM, by their digests.
#include "adapt/loop/template_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::TemporaryFolder, test::world;

std::vector<std::string> keys_of(const CaseSettings& files) {
  std::vector<std::string> keys;
  for (const auto& [key, digest] : files) keys.push_back(key);
  return keys;
}

/// On the root; others have no folder of their own.
TEST(TemplateFiles, OfOpenfoamAreThoseThatAreCopied) {
  const TemporaryFolder folder;
  if (world().is_root()) {
    for (const char* part : {"0", "system", "constant/polyMesh", "600", "processor0", "postProcessing"})
      std::filesystem::create_directories(folder.file(part));
    for (const char* name : {"0/U", "system/controlDict", "Allrun", "constant/polyMesh/points", "600/U",
                             "processor0/x", "log.run", "postProcessing/x"})
      test::write_bytes(folder.file(name), "a");
    OpenfoamSolver solver;
    solver.case_template = folder.file("");
    const CaseSettings files = template_files(solver);
    EXPECT_EQ(keys_of(files), (std::vector<std::string>{template_key("0/U"), template_key("Allrun"),
                                                        template_key("system/controlDict")}));
    EXPECT_EQ(files[0].second, files[1].second) << "the same bytes";
    EXPECT_EQ(files[0].second.size(), 18U) << "16 digits in quotes";
    test::write_bytes(folder.file("0/U"), "b");
    const CaseSettings now = template_files(solver);
    EXPECT_NE(files[0].second, now[0].second);
    EXPECT_EQ(files[1], now[1]);
    EXPECT_NE(template_digest(files), template_digest(now));
  }
  world().barrier();
}

TEST(TemplateFiles, OfSu2AreItsConfiguration) {
  const TemporaryFolder folder;
  if (world().is_root()) {
    test::write_bytes(folder.file("flow.cfg"), "MACH_NUMBER= 0.8\n");
    const CaseSettings files = template_files(Su2Solver{folder.file("flow.cfg"), {}, {}, {}});
    EXPECT_EQ(keys_of(files), std::vector<std::string>{template_key("flow.cfg")});
    EXPECT_TRUE(template_files(Su2Solver{folder.file("none.cfg"), {}, {}, {}}).empty());
  }
  world().barrier();
  EXPECT_TRUE(template_files(flow::EulerOptions{}).empty());
  EXPECT_TRUE(template_files(CommandSolver{}).empty());
}

}  // namespace
}  // namespace quadloop::adapt
