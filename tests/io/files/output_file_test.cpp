// Outputs appear whole or not at all, and every rank learns of a failure.
#include "io/files/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/files/folder_lock.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

/// Lets no file of this process grow beyond a size, which fails as a full disk does; from one call to the
/// next of the tests' own thread.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_{std::signal(SIGXFSZ, SIG_IGN)} {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

TEST(OutputSet, MissingFolderIsRefusedOnAllRanks) {
  const TemporaryFolder folder;
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  const std::string inside = folder.file("missing/out");
  EXPECT_EQ(test::status_of([&] { test::write_alone(world(), own, inside + ".mesh"); }),
            ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] { test::write_alone(world(), own, inside + ".cgns"); }),
            ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] {
              write_tree(world(), test::sample_tree(10, world().rank(), world().size()), inside + ".h5");
            }),
            ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] {
              OutputSet outputs(world());
              write_native(outputs, MeshStream(world(), own), folder.path());
            }),
            ExitStatus::output_failed);
  EXPECT_EQ(test::files_in(folder.path()), 0U);
}

TEST(OutputSet, FullDiskLeavesNothingBehindWhereverItIsMet) {
  const TemporaryFolder folder;
  const Mesh own = test::share_of(test::sample_mesh(50), world().rank(), world().size());
  const TreeRecord tree = test::sample_tree(500, world().rank(), world().size());
  for (const char* name : {"m.mesh", "m.cgns", "m.vtu", "m.su2", "m.msh", "m.h5"}) {
    const std::string path = folder.file(name);
    for (const rlim_t bytes : {0, 1, 100, 500, 800, 1500, 2100}) {
      const SmallFiles full(bytes);
      const std::string said = test::refusal_text<Error>([&] {
        OutputSet outputs(world());
        if (path.ends_with(".h5"))
          write_tree(outputs, tree, path);
        else
          write_mesh(outputs, own, path);
        outputs.commit();
      });
      world().barrier();
      EXPECT_EQ(said.find(path + ": cannot be written: File too large"), 0U) << bytes << ": " << said;
      EXPECT_EQ(test::files_in(folder.path()), 0U);
      world().barrier();
    }
  }
}

TEST(OutputSet, OldFilesComeBackWhereOneCannotBeReplaced) {
  const TemporaryFolder folder;
  const std::string first = folder.file("a.mesh"), second = folder.file("b.mesh"),
                    third = folder.file("c.mesh");
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  if (world().is_root()) test::write_bytes(first, "old");
  {
    OutputSet outputs(world());
    for (const std::string& path : {first, second, third}) write_mesh(outputs, own, path);
    if (world().is_root()) std::filesystem::create_directory(third);
    EXPECT_EQ(test::status_of([&] { outputs.commit(); }), ExitStatus::output_failed);
  }
  world().barrier();
  EXPECT_EQ(test::bytes_of(first), "old");
  EXPECT_FALSE(std::filesystem::exists(second));
  EXPECT_EQ(test::files_in(folder.path()), 2U);  // the first, and the folder in the way
}

TEST(OutputSet, TwoSetsOfTheSameFilesDoNotMeet) {
  const TemporaryFolder folder;
  const Mesh small = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  const Mesh large = test::share_of(test::sample_mesh(9), world().rank(), world().size());
  test::write_alone(world(), small, folder.file("small.mesh"));
  test::write_alone(world(), large, folder.file("large.mesh"));
  OutputSet first(world()), second(world());
  write_mesh(first, small, folder.file("m.mesh"));
  write_mesh(second, large, folder.file("m.mesh"));
  second.commit();
  EXPECT_EQ(test::bytes_of(folder.file("m.mesh")), test::bytes_of(folder.file("large.mesh")));
  world().barrier();
  first.commit();
  EXPECT_EQ(test::bytes_of(folder.file("m.mesh")), test::bytes_of(folder.file("small.mesh")));
  EXPECT_EQ(test::files_in(folder.path()), 3U);
}

TEST(OutputSet, AHeldLockIsWaitedFor) {
  const TemporaryFolder folder;
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  std::thread other;
  if (world().is_root()) {
    auto lock = FolderLock::attempt(folder.path());
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FolderLock::attempt(folder.path()));
    other = std::thread([held = std::move(*lock), &folder] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      EXPECT_FALSE(std::filesystem::exists(folder.file("m.mesh")));
    });
  }
  test::write_alone(world(), own, folder.file("m.mesh"));
  if (other.joinable()) other.join();
  EXPECT_EQ(test::files_in(folder.path()), 1U);
}

TEST(OutputSet, OldFilesStandUntilTheCommit) {
  const TemporaryFolder folder;
  const std::string first = folder.file("a.mesh"), second = folder.file("b.mesh");
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  if (world().is_root()) test::write_bytes(first, "old");
  {
    OutputSet outputs(world());
    write_mesh(outputs, own, first);
    EXPECT_EQ(test::bytes_of(first), "old");
    EXPECT_EQ(test::status_of([&] { write_mesh(outputs, own, folder.file("missing/b.mesh")); }),
              ExitStatus::output_failed);
  }
  world().barrier();
  EXPECT_EQ(test::bytes_of(first), "old");
  EXPECT_EQ(test::files_in(folder.path()), 1U);
  world().barrier();
  OutputSet outputs(world());
  write_mesh(outputs, own, first);
  write_mesh(outputs, own, second);
  outputs.commit();
  EXPECT_EQ(test::bytes_of(first), test::bytes_of(second));
  EXPECT_NE(test::bytes_of(first), "old");
  EXPECT_EQ(test::files_in(folder.path()), 2U);
}

TEST(OutputSet, AFolderAppearsWithItsFilesOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder.file("mesh");
  const auto stage = [&](bool commit) {
    OutputSet outputs(world());
    const std::vector<StagedFile> staged = outputs.stage_folder(path, {"a", "b"});
    EXPECT_EQ(staged[1].path, path + "/b");
    if (commit) outputs.commit();
  };
  stage(false);
  world().barrier();
  EXPECT_FALSE(std::filesystem::exists(path));
  world().barrier();
  stage(true);
  stage(true);  // over the old files
  world().barrier();
  EXPECT_TRUE(std::filesystem::exists(path + "/a"));
  EXPECT_TRUE(std::filesystem::exists(path + "/b"));
  folder.write("mesh/c", "another's");
  EXPECT_THROW(stage(true), OutputError);
}

}  // namespace
}  // namespace quadloop::io
