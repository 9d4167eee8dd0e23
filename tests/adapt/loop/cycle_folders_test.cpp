// The folder of a run: cycles that are whole, and what is left of others.
#include "adapt/loop/cycle_folders.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "adapt/loop/resume.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder, test::world;

/// On the root alone, then seen by all.
template <class Work>
void on_root(const Work& work) {
  world().together([&] {
    if (world().is_root()) work();
  });
}

void write(const std::string& path, const std::string& text = "x") {
  on_root([&] { std::ofstream(path) << text; });
}

TEST(CycleFolders, ACycleIsThereWhenItIsWhole) {
  const TemporaryFolder temporary;
  CycleFolders run(world(), temporary.file("run"));
  EXPECT_EQ(run.open(false), 0);
  run.begin(0);
  write(run.under_way(0) + "/mesh.mesh");
  EXPECT_FALSE(fs::exists(run.whole(0)));
  world().barrier();
  run.finish(0);
  EXPECT_TRUE(fs::exists(run.whole(0) + "/mesh.mesh"));
  EXPECT_FALSE(fs::exists(run.under_way(0)));
}

TEST(CycleFolders, BeginningAgainStartsEmpty) {
  const TemporaryFolder temporary;
  CycleFolders run(world(), temporary.file("run"));
  run.open(false);
  run.begin(0);
  write(run.under_way(0) + "/left");
  run.begin(0);
  EXPECT_TRUE(fs::is_empty(run.under_way(0)));
  world().barrier();
}

TEST(CycleFolders, ResumingCountsWholeCyclesAndDropsTheOneUnderWay) {
  const TemporaryFolder temporary;
  std::optional<CycleFolders> run(std::in_place, world(), temporary.file("run"));
  run->open(false);
  for (const int cycle : {0, 1}) {
    run->begin(cycle);
    run->finish(cycle);
  }
  run->begin(2);
  run.emplace(world(), temporary.file("run"));  // the lock goes with the earlier one
  EXPECT_NE(test::refusal_text([&] {
              CycleFolders(world(), temporary.file("run")).open(false);
            }).find("resume the run in it"),
            std::string::npos);
  EXPECT_EQ(run->open(true), 2);
  EXPECT_FALSE(fs::exists(run->under_way(2)));
}

TEST(CycleFolders, AFailedFirstCycleIsNoRun) {
  const TemporaryFolder temporary;
  std::optional<CycleFolders> run(std::in_place, world(), temporary.file("run"));
  run->open(false);
  run->begin(0);
  run.emplace(world(), temporary.file("run"));
  EXPECT_EQ(run->open(false), 0);
}

TEST(CycleFolders, AMissingCycleIsNamed) {
  const TemporaryFolder temporary;
  on_root([&] {
    fs::create_directories(temporary.file("run/cycle_00"));
    fs::create_directories(temporary.file("run/cycle_02"));
    fs::create_directories(temporary.file("run/cycle_9x"));  // none of ours
  });
  const std::string refusal =
      test::refusal_text([&] { CycleFolders(world(), temporary.file("run")).open(true); });
  EXPECT_NE(refusal.find("cycle_01: is missing, but cycle_02 exists"), std::string::npos) << refusal;
}

TEST(CycleFolders, TwoRunsDoNotShareAFolder) {
  const TemporaryFolder temporary;
  CycleFolders run(world(), temporary.file("run"));
  run.open(false);
  EXPECT_NE(test::refusal_text([&] {
              CycleFolders(world(), temporary.file("run")).open(true);
            }).find("another run is using"),
            std::string::npos);
}

/// What is refused to a run of this start that is resumed; empty: nothing.
std::string refusal_to_resume(const TemporaryFolder& temporary, const std::string& start) {
  return test::refusal_text([&] { CycleFolders(world(), temporary.file("run")).open(true, start); });
}

TEST(CycleFolders, AFirstCycleIsResumedAsItWasBegun) {
  const TemporaryFolder temporary;
  const auto begin = [&](const std::string& start) {
    CycleFolders run(world(), temporary.file("run"));
    run.open(false, start);
    run.begin(0);
  };
  begin("0123456789abcdef base/mesh.mesh");
  for (const char* other : {"", "fedcba9876543210 base/mesh.mesh"})
    EXPECT_NE(refusal_to_resume(temporary, other).find("began with the mesh of base/mesh.mesh"),
              std::string::npos)
        << other;
  {
    CycleFolders run(world(), temporary.file("run"));
    EXPECT_EQ(run.open(true, "0123456789abcdef elsewhere/mesh.mesh"), 0);  // the same mesh
  }
  begin("");  // anew, with a mesh of its own
  EXPECT_NE(refusal_to_resume(temporary, "0123456789abcdef base").find("began with the mesh of its case"),
            std::string::npos);
  CycleFolders run(world(), temporary.file("run"));
  EXPECT_EQ(run.open(true), 0);
}

TEST(CycleFolders, AFileIsNoFolder) {
  const TemporaryFolder temporary;
  write(temporary.file("run"));
  EXPECT_NE(
      test::refusal_text([&] { CycleFolders(world(), temporary.file("run")).open(false); }).find("is a file"),
      std::string::npos);
}

/// A cycle whose record is of these settings.
CycleRecord record_with(const CaseSettings& settings) {
  CycleRecord record;
  record.settings = settings;
  record.geometry_digest = 7;
  record.case_digest = run_digest(settings, 7);
  return record;
}

TEST(Resume, SettingsThatMayChangeAreWarnedOfAndOthersRefused) {
  const TemporaryFolder temporary;
  const CaseSettings before{{"adapt.refine", "1"}, {"solver.iterations", "5"}};
  write(temporary.file("record.json"), json_text(record_with(before)));
  EXPECT_TRUE(require_same_run(world(), temporary.path(), record_with(before)).empty());
  const auto warnings = require_same_run(world(), temporary.path(),
                                         record_with({{"adapt.refine", "1"}, {"solver.iterations", "9"}}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("solver.iterations was 5, is now 9")) << warnings[0];
  const auto refused = test::refusal_text([&] {
    require_same_run(world(), temporary.path(),
                     record_with({{"adapt.refine", "2"}, {"solver.iterations", "9"}}));
  });
  EXPECT_NE(refused.find("belongs to another case: adapt.refine was 1, is now 2;"), std::string::npos)
      << refused;
}

TEST(Resume, AnotherOutlineIsRefused) {
  const TemporaryFolder temporary;
  const CaseSettings settings{{"adapt.refine", "1"}};
  write(temporary.file("record.json"), json_text(record_with(settings)));
  CycleRecord now = record_with(settings);
  now.geometry_digest = 8;
  now.case_digest = run_digest(settings, 8);
  EXPECT_NE(test::refusal_text([&] {
              require_same_run(world(), temporary.path(), now);
            }).find("the geometry in the files"),
            std::string::npos);
}

TEST(Resume, ADamagedOrMissingRecordSaysHowToBeRidOfIt) {
  const TemporaryFolder temporary;
  const auto refusal = [&] {
    return test::refusal_text([&] { require_same_run(world(), temporary.path(), record_with({})); });
  };
  EXPECT_NE(refusal().find("is missing or cannot be read; restore the file"), std::string::npos) << refusal();
  write(temporary.file("record.json"), "{");
  EXPECT_NE(refusal().find("is not a complete record of a cycle; restore"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace quadloop::adapt
