// A file that all ranks write at once.
#include "io/files/shared_output.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

TEST(SharedOutput, HoldsWhatEachRankWroteAtItsPlace) {
  const test::TemporaryFolder folder;
  OutputSet outputs(world());
  SharedOutput file(outputs, outputs.stage(folder.file("a.bin")));
  file.together([&] {
    for (int part = 1; part >= 0; --part)  // in no order
      file.write_at(2 * world().rank() + part,
                    std::string(1, static_cast<char>('a' + 2 * world().rank() + part)));
  });
  file.close();
  outputs.commit();
  if (world().is_root()) {
    EXPECT_EQ(test::bytes_of(folder.file("a.bin")), std::string("abcdefghij").substr(0, 2 * world().size()));
  }
}

TEST(SharedOutput, AFailureOfAnyRankEndsOnAll) {
  const test::TemporaryFolder folder;
  OutputSet outputs(world());
  const StagedFile staged = outputs.stage(folder.file("a.bin"));
  SharedOutput file(outputs, staged);
  const int last = world().size() - 1;
  EXPECT_THROW(file.together([&] {
    if (world().rank() == last) file.write_at(-1, "x");
  }),
               OutputError);
  EXPECT_THROW(SharedOutput(outputs, {"b.bin", folder.file("missing")}), OutputError);
}

/// Files that this process has open, the folder that tells of them among them.
std::ptrdiff_t open_files() {
  return std::ranges::distance(std::filesystem::directory_iterator("/proc/self/fd"));
}

/// No further file can be opened as long as it lives.
class NoFurtherFile {
 public:
  NoFurtherFile() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    rlimit none = before_;
    none.rlim_cur = 0;
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoFurtherFile() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoFurtherFile(const NoFurtherFile&) = delete;
  NoFurtherFile& operator=(const NoFurtherFile&) = delete;

 private:
  rlimit before_{};
};

TEST(SharedOutput, WritesTheBytesOfARankThatCannotOpenTheFile) {
  if (world().size() == 1) return;
  const test::TemporaryFolder folder;
  OutputSet outputs(world());
  const StagedFile staged = outputs.stage(folder.file("a.bin"));
  std::optional<SharedOutput> file;
  {
    std::optional<NoFurtherFile> limit;
    if (world().rank() != 0) limit.emplace();
    file.emplace(outputs, staged);
  }
  const std::string own(3, static_cast<char>('a' + world().rank()));
  file->together([&] { file->write_at(3 * world().rank(), own); });
  EXPECT_THROW(file->together([&] {
    if (world().rank() == world().size() - 1) throw InputError("broken");
    file->write_at(3 * world().rank(), own);
  }),
               InputError);
  if (world().rank() == 0) {  // a failure there leaves no rank waiting
    EXPECT_THROW(file->together([&] { throw InputError("broken"); }), InputError);
  } else {
    EXPECT_THROW(file->together([&] { file->write_at(3 * world().rank(), own); }), InputError);
  }
  EXPECT_THROW(file->together([&] {
    if (world().rank() == 1) file->write_at(std::numeric_limits<std::int64_t>::max(), own);
  }),
               OutputError);
  file->close();
  outputs.commit();
  if (world().is_root()) {
    EXPECT_EQ(test::bytes_of(folder.file("a.bin")),
              std::string("aaabbbcccdddeee").substr(0, 3 * world().size()));
  }
  world().barrier();
}

TEST(SharedOutput, NoRankKeepsAFileOpenThatRankZeroCouldNotOpen) {
  const test::TemporaryFolder folder;
  OutputSet outputs(world());
  const StagedFile staged = outputs.stage(folder.file("a.bin"));
  const std::ptrdiff_t before = open_files();
  {
    std::optional<NoFurtherFile> limit;
    if (world().is_root()) limit.emplace();
    EXPECT_THROW(SharedOutput(outputs, staged), OutputError);
  }
  EXPECT_EQ(open_files(), before);
}

TEST(SharedOutput, WhatDoesNotReachTheDiskLeavesNoFile) {
  const test::TemporaryFolder folder;
  const std::ptrdiff_t before = open_files();
  {
    OutputSet outputs(world());
    SharedOutput file(outputs, outputs.stage(folder.file("a.bin")));
    file.close();
    const int last = world().size() - 1;
    if (world().rank() == last) {
      std::array<int, 2> pipe{};
      ASSERT_EQ(::pipe(pipe.data()), 0);
      ::close(pipe[0]);
      outputs.take_over(pipe[1], "a.bin");  // a pipe has no disk: fsync refuses it
    }
    EXPECT_THROW(outputs.commit(), OutputError);
  }
  world().barrier();
  EXPECT_EQ(open_files(), before);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.bin")));
}

}  // namespace
}  // namespace quadloop::io
