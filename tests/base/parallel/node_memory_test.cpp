// Arrays of the first rank on all ranks: one memory for the ranks of a node, or copies where it is refused.
#include "mesher/base/parallel/node_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "mesher/base/parallel/memory_file.hpp"
#include "mesher/base/parallel/shared_array.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// Longer than a page, and no whole number of pages.
std::vector<std::int64_t> numbers() {
  std::vector<std::int64_t> values(100003);
  std::iota(values.begin(), values.end(), -5);
  return values;
}

SharedArray<std::int64_t> numbers_of_first() {
  return world().is_root() ? numbers() : std::vector<std::int64_t>{world().rank()};
}

template <class T>
std::vector<T> list_of(const SharedArray<T>& array) {
  return {array.begin(), array.end()};
}

/// How this process has mapped an address.
struct Mapping {
  std::string permissions, file;
  std::int64_t inode = 0;  ///< 0: memory of this process alone
};

Mapping mapping_of(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    Mapping mapping;
    std::string offset, device;
    words >> std::hex >> begin >> dash >> end >> mapping.permissions >> offset >> device >> std::dec >>
        mapping.inode >> mapping.file;
    if (begin <= at && at < end) return mapping;
  }
  return {};
}

/// Numbers of the files that this process has open, and of its maps of memory files.
std::pair<std::ptrdiff_t, int> open_files() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  int maps = 0;
  std::ifstream text("/proc/self/maps");
  for (std::string line; std::getline(text, line);) maps += line.find("memfd:quadloop") != std::string::npos;
  return {std::distance(begin(files), end(files)), maps};
}

/// The number that the next file gets; as limit it permits no more files.
rlim_t free_number() {
  const int number = ::dup(0);
  ::close(number);
  return static_cast<rlim_t>(number);
}

/// A limit of this process, as long as it lives.
class Limit {
 public:
  Limit(decltype(RLIMIT_FSIZE) of, rlim_t value) : of_{of} {
    getrlimit(of_, &before_);
    rlimit limit = before_;
    limit.rlim_cur = value;
    setrlimit(of_, &limit);
  }
  ~Limit() { setrlimit(of_, &before_); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

 private:
  decltype(RLIMIT_FSIZE) of_;
  rlimit before_{};
};

TEST(NodeMemory, AllRanksHaveTheArrayOfTheFirst) {
  const NodeMemory memory(world());
  EXPECT_EQ(list_of(memory.once_per_node(numbers_of_first())), numbers());
  const std::vector<char> letters{'a', 'b', 'c'};
  EXPECT_EQ(list_of(memory.once_per_node(SharedArray(world().is_root() ? letters : std::vector<char>{}))),
            letters);
  EXPECT_TRUE(
      memory.once_per_node(SharedArray(world().is_root() ? std::vector<double>{} : std::vector<double>{1.0}))
          .empty());
}

TEST(NodeMemory, TheRanksOfANodeShareOneMemoryThatIsReadOnly) {
  const NodeMemory memory(world());
  const SharedArray<std::int64_t> given = numbers_of_first(), array = memory.once_per_node(given);
  if (world().size() == 1) {
    EXPECT_EQ(array.data(), given.data());
    return;
  }
  const Mapping mapping = mapping_of(array.data());
  EXPECT_EQ(mapping.permissions, "r--s");
  EXPECT_EQ(mapping.file, "/memfd:quadloop");
  EXPECT_GT(mapping.inode, 0);
  EXPECT_EQ(world().all_gather(mapping.inode),
            std::vector<std::int64_t>(static_cast<std::size_t>(world().size()), mapping.inode));
}

TEST(NodeMemory, EachNodeHasItsOwn) {
  const int nodes = 2, node = world().rank() % nodes;
  const NodeMemory memory(world(), node);
  const SharedArray<std::int64_t> array = memory.once_per_node(numbers_of_first());
  EXPECT_EQ(list_of(array), numbers());
  const std::vector<std::int64_t> inodes = world().all_gather(mapping_of(array.data()).inode);
  for (int rank = 0; rank < world().size(); ++rank) {
    const std::int64_t first = inodes[static_cast<std::size_t>(rank % nodes)];
    EXPECT_EQ(inodes[static_cast<std::size_t>(rank)], first) << rank;
  }
  if (world().size() > 3) {
    EXPECT_NE(inodes[0], inodes[1]);
  }
  const bool is_alone = world().size() <= node + nodes;
  EXPECT_EQ(inodes[static_cast<std::size_t>(world().rank())] == 0, is_alone);
}

TEST(NodeMemory, EachRankHasACopyWhereARankIsRefused) {
  const NodeMemory memory(world());
  memory.once_per_node(numbers_of_first());  // from here on MPI needs no more files
  struct Refusal {
    decltype(RLIMIT_FSIZE) of;
    int rank;
    rlim_t limit;
  };
  const int last = world().size() - 1;
  const std::vector<Refusal> refusals{
      {RLIMIT_FSIZE, 0, 100000},              // the first rank can make no file of this length
      {RLIMIT_NOFILE, 0, free_number()},      // or none at all
      {RLIMIT_NOFILE, last, free_number()}};  // the last one cannot open it
  for (const auto& [of, rank, value] : refusals) {
    const auto before = open_files();
    {
      SharedArray<std::int64_t> array;
      {
        std::optional<Limit> limit;
        if (world().rank() == rank) limit.emplace(of, value);
        array = memory.once_per_node(numbers_of_first());
      }
      EXPECT_EQ(list_of(array), numbers());
      EXPECT_EQ(mapping_of(array.data()).inode, 0) << "memory of this rank alone";
    }
    EXPECT_EQ(open_files(), before);
  }
}

TEST(NodeMemory, LastsAsLongAsAnyoneUsesItAndLeavesNothing) {
  const auto before = open_files();
  const NodeMemory memory(world());
  SharedArray<std::int64_t> array = memory.once_per_node(numbers_of_first());
  EXPECT_EQ(open_files().first, before.first) << "the file is closed";
  const SharedArray<std::int64_t> copy = array;
  EXPECT_EQ(copy.data(), array.data());
  array = {};
  EXPECT_EQ(copy[7], 2);
  {
    SharedArray<std::int64_t> of_some_ranks = copy;
    if (world().rank() % 2 == 0) of_some_ranks = {};
    world().barrier();
    EXPECT_TRUE(of_some_ranks.empty() || of_some_ranks[7] == 2);
  }
  EXPECT_EQ(list_of(copy), numbers());
}

TEST(MemoryFile, IsOnlyMappedIfItIsTheSame) {
  const auto before = open_files();
  {
    std::optional<MemoryFile> file = MemoryFile::of_size(3), other = MemoryFile::of_size(3);
    ASSERT_TRUE(file && other);
    file->bytes()[1] = std::byte{7};
    EXPECT_EQ(mapped(file->place())[1], std::byte{7});
    MemoryFile::Place wrong = file->place();
    wrong.descriptor = other->place().descriptor;
    EXPECT_TRUE(mapped(wrong).empty()) << "the number of another file";
    wrong.descriptor = -1;
    EXPECT_TRUE(mapped(wrong).empty());
    EXPECT_EQ(std::move(*file).finished()[1], std::byte{7});
  }
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace quadloop
