// What may still be filled, as the system's own files tell it; the control groups' are made here.
#include "mesher/base/parallel/free_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::TemporaryFolder;

constexpr double mib = 1 << 20;

/// What this process has of what its limit RLIMIT_DATA counts.
double bytes_of_data() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmData:") {
  }
  double kib = 0;
  status >> kib;
  return 1024 * kib;
}

TEST(FreeMemory, ALimitOfTheProcessLeavesWhatItHasNotTaken) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  rlimit limit = before;
  limit.rlim_cur = static_cast<rlim_t>(bytes_of_data() + 64 * mib);
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &limit), 0);
  const double left = free_memory_of_all(test::world());
  setrlimit(RLIMIT_DATA, &before);
  EXPECT_NEAR(left, 64 * mib, 4 * mib);  // the process goes on living
  EXPECT_GT(free_memory_of_all(test::world()), left);
}

TEST(FreeMemory, AGroupLeavesItsLimitLessWhatItMustKeep) {
  const TemporaryFolder root;
  root.write("job/memory.max", "1000\n");
  root.write("job/memory.current", "700\n");
  root.write("job/memory.stat", "anon 500\ninactive_file 150\n");
  EXPECT_EQ(free_in_control_groups("0::/job\n", root.path()), 450);
}

TEST(FreeMemory, TheGroupsAboveLimitItToo) {
  const TemporaryFolder root;
  root.write("job/memory.max", "100\n");
  root.write("job/memory.current", "70\n");
  root.write("job/step/memory.max", "max\n");
  root.write("job/step/memory.current", "10\n");
  EXPECT_EQ(free_in_control_groups("0::/job/step\n", root.path()), 30);
}

TEST(FreeMemory, TheOlderKindOfGroupsIsReadToo) {
  const TemporaryFolder root;
  root.write("memory/job/memory.limit_in_bytes", "1000\n");
  root.write("memory/job/memory.usage_in_bytes", "400\n");
  EXPECT_EQ(free_in_control_groups("5:cpu,cpuacct:/other\n4:memory:/job\n0::/\n", root.path()), 600);
}

TEST(FreeMemory, WithoutGroupsThereIsNoLimit) {
  EXPECT_TRUE(std::isinf(free_in_control_groups("0::/\n", "/nowhere")));
}

/// Bytes of memory in use by this process.
std::int64_t resident() {
  std::ifstream file("/proc/self/statm");
  std::int64_t all = 0, used = 0;
  file >> all >> used;
  return used * ::sysconf(_SC_PAGESIZE);
}

#ifndef __SANITIZE_ADDRESS__  // has its own allocation
TEST(ReturnFreedMemory, FreedBlocksAreNoLongerInUse) {
  constexpr std::size_t blocks = 50000, block = 1000;
  std::vector<std::unique_ptr<char[]>> held(blocks);
  for (auto& one : held) {
    one = std::make_unique<char[]>(block);
    std::fill_n(one.get(), block, 'x');
  }
  const auto last = std::make_unique<char[]>(block);  // lies behind them
  const std::int64_t before = resident();
  held.clear();
  return_freed_memory();
  EXPECT_LT(resident(), before - static_cast<std::int64_t>(blocks * block / 2));
}
#endif

}  // namespace
}  // namespace quadloop
