#include "app/heap.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace quadloop {
namespace {

constexpr std::size_t mib = 0x1p20;

/// Bytes of memory that the process holds.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t whole = 0, pages = 0;
  file >> whole >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// The flags of the mapping that holds an address, as in "rd wr mr mw me ac hg".
std::string flags_at(const void* address) {
  std::ifstream file("/proc/self/smaps");
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-') inside = begin <= at && at < end;
    if (inside && line.starts_with("VmFlags:")) return line;
  }
  return {};
}

class Heap : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
    GTEST_SKIP() << "another heap";
#endif
    set_up_heap();
  }
};

TEST_F(Heap, LargeArraysGoBackToTheSystem) {
  const std::size_t before = resident();
  std::vector<std::vector<char>> small, large;
  for (int i = 0; i < 4; ++i) {
    large.emplace_back(spare_end + large_array, 'x');
    small.emplace_back(mib, 'x');  // on top of which the heap would not shrink
  }
  EXPECT_GE(resident(), before + 4 * spare_end);
  large = {};
  EXPECT_LT(resident(), before + large_array);
}

TEST_F(Heap, SmallOnesAreKept) {
  const auto fill = [] { std::vector<std::vector<char>>(16, std::vector<char>(mib, 'x')); };
  fill();
  const long before = page_faults();
  fill();
  EXPECT_LT(page_faults() - before, 256);  // of 4096 pages
}

TEST_F(Heap, LargeArraysAskForHugePages) {
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled")) GTEST_SKIP() << "the system has none";
  const std::vector<char> large(large_array, 'x');
  EXPECT_NE(flags_at(large.data() + large_array / 2).find(" hg"), std::string::npos);
}

}  // namespace
}  // namespace quadloop
