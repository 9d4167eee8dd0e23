// Outputs appear whole or not at all, and every rank learns of a failure.
#include "io/output_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/cgns_file.hpp"
#include "io/native_file.hpp"
#include "io/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::TemporaryFolder;
using test::world;

/// Puts a link to the device that is always full where the temporary will be written.
void fill_disk(const std::string& path) {
  if (world().is_root()) std::filesystem::create_symlink("/dev/full", path + ".part");
  world().barrier();
}

TEST(OutputSet, MissingFolderIsRefusedOnAllRanks) {
  const TemporaryFolder folder;
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  const std::string inside = folder.file("missing/out");
  EXPECT_EQ(test::status_of([&] { write_native(world(), own, inside + ".mesh"); }), ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] { write_cgns(world(), own, inside + ".cgns"); }), ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] { write_tree(world(), test::sample_tree(10, world().rank(), world().size()), inside + ".h5"); }),
            ExitStatus::output_failed);
  EXPECT_EQ(test::status_of([&] { write_native(world(), own, folder.path()); }), ExitStatus::output_failed);
  EXPECT_EQ(test::files_in(folder.path()), 0U);
}

TEST(OutputSet, FullDiskLeavesNothingBehind) {
  const TemporaryFolder folder;
  const Mesh own = test::share_of(test::sample_mesh(500), world().rank(), world().size());
  fill_disk(folder.file("m.mesh"));
  EXPECT_EQ(test::status_of([&] { write_native(world(), own, folder.file("m.mesh")); }), ExitStatus::output_failed);
  world().barrier();
  EXPECT_EQ(test::files_in(folder.path()), 0U);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(OutputSet, OldFilesStandUntilTheCommit) {
  const TemporaryFolder folder;
  const std::string first = folder.file("a.mesh"), second = folder.file("b.mesh");
  const Mesh own = test::share_of(test::sample_mesh(5), world().rank(), world().size());
  if (world().is_root()) test::write_bytes(first, "old");
  {
    OutputSet outputs(world());
    write_native(outputs, own, first);
    EXPECT_EQ(test::bytes_of(first), "old");
    EXPECT_EQ(test::status_of([&] { write_native(outputs, own, folder.file("missing/b.mesh")); }), ExitStatus::output_failed);
  }
  world().barrier();
  EXPECT_EQ(test::bytes_of(first), "old");
  EXPECT_EQ(test::files_in(folder.path()), 1U);
  world().barrier();
  OutputSet outputs(world());
  write_native(outputs, own, first);
  write_native(outputs, own, second);
  outputs.commit();
  EXPECT_EQ(test::bytes_of(first), test::bytes_of(second));
  EXPECT_NE(test::bytes_of(first), "old");
  EXPECT_EQ(test::files_in(folder.path()), 2U);
}

}  // namespace
}  // namespace quadloop
