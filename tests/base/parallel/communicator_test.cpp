// Ranks that speak and fail together; the Morton curve; stages and their seconds.
#include "mesher/base/parallel/communicator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <thread>

#include "mesher/base/error.hpp"
#include "mesher/base/morton.hpp"
#include "mesher/base/timer.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

TEST(Communicator, SumsListsEntryByEntry) {
  const std::int64_t rank = world().rank(), ranks = world().size();
  EXPECT_EQ(world().sum(std::vector<std::int64_t>{1, rank, -rank * rank}),
            (std::vector<std::int64_t>{ranks, ranks * (ranks - 1) / 2,
                                       -ranks * (ranks - 1) * (2 * ranks - 1) / 6}));
  EXPECT_TRUE(world().sum(std::vector<std::int64_t>{}).empty());
}

TEST(Communicator, ReducesOverAllRanks) {
  const std::int64_t rank = world().rank(), last = world().size() - 1;
  EXPECT_EQ(world().sum(rank), last * (last + 1) / 2);
  EXPECT_EQ(world().exclusive_sum(rank + 1), rank * (rank + 1) / 2);
  EXPECT_EQ(world().minimum(rank - 7), -7);
  EXPECT_EQ(world().maximum(0.5 * static_cast<double>(rank)), 0.5 * static_cast<double>(last));
  EXPECT_TRUE(world().any(rank == last));
  EXPECT_FALSE(world().any(false));
}

TEST(Communicator, GathersListsOfAnyLength) {
  std::vector<std::int32_t> own(world().rank() % 2 == 0 ? 0 : world().rank());
  std::iota(own.begin(), own.end(), 10 * world().rank());
  std::vector<std::int32_t> expected;
  for (int rank = 1; rank < world().size(); rank += 2) {
    for (int i = 0; i < rank; ++i) expected.push_back(10 * rank + i);
  }
  EXPECT_EQ(world().all_gather_values(std::span<const std::int32_t>(own)), expected);
}

TEST(Communicator, BroadcastsListsAndWords) {
  const int last = world().size() - 1;
  std::vector<double> values(world().rank() == last ? 3 : 1, world().rank() + 0.5);
  world().broadcast(values, last);
  EXPECT_EQ(values, std::vector<double>(3, last + 0.5));
  const std::vector<std::string> words{"", "a b", "", "\n"},
      mine = world().is_root() ? words : std::vector<std::string>{"x"};
  EXPECT_EQ(broadcast_words(world(), mine), words);
  EXPECT_TRUE(broadcast_words(world(), {}).empty());
}

TEST(Communicator, TheLowestRanksErrorIsThrownOnAll) {
  const int last = world().size() - 1;
  int done = 0;
  EXPECT_NO_THROW(world().together([&] { ++done; }));
  EXPECT_EQ(done, 1);
  try {
    world().together([&] {
      if (world().rank() == last) throw OutputError("the last rank's");
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::output_failed);
    EXPECT_STREQ(error.what(), "the last rank's");
  }
  try {
    world().together([&] { throw InputError("rank " + std::to_string(world().rank())); });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "rank 0");
  }
}

TEST(Communicator, CountsGoFromAnyRankToAny) {
  // Rank a sends to rank b in round r if this is not 0. Ranks are late in turns, so that rounds overlap.
  const auto count = [](int a, int b, int r) { return (a * 7 + b * 5 + r * 3) % 4 * (r % 8); };
  const int size = world().size(), own = world().rank();
  for (int round = 0; round < 64; ++round) {
    if (round % size == own) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::vector<Communicator::Count> to;
    std::vector<std::pair<int, std::int64_t>> expected, found;
    for (int other = size - 1; other >= 0; --other) {
      if (count(own, other, round) != 0) to.push_back({other, count(own, other, round)});
    }
    for (int other = 0; other < size; ++other) {
      if (count(other, own, round) != 0) expected.emplace_back(other, count(other, own, round));
    }
    for (const int many : {1, Communicator::many_ranks}) {
      found.clear();
      for (const auto& [rank, number] : world().exchange_counts(to, many)) found.emplace_back(rank, number);
      EXPECT_EQ(found, expected) << round << ' ' << many;
    }
  }
}

TEST(Communicator, BroadcastsInPiecesOfAnySize) {
  const int last = world().size() - 1;
  std::vector<std::byte> sent(1000);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::byte>(i % 251);
  for (const std::size_t piece : {1, 7, 500, 1000, 4096}) {
    std::vector<std::byte> bytes = world().rank() == last ? sent : std::vector<std::byte>(sent.size());
    world().broadcast_bytes(bytes, last, piece);
    EXPECT_EQ(bytes, sent) << piece;
  }
}

TEST(Communicator, HasGroupsOfItsRanks) {
  const int rank = world().rank(), ranks = world().size();
  const Communicator part = world().ranks_with(rank % 2);
  EXPECT_EQ(part.rank(), rank / 2) << "in the order of the ranks";
  EXPECT_EQ(part.size(), (ranks + 1 - rank % 2) / 2);
  EXPECT_EQ(part.sum(rank), part.size() * (rank % 2) + part.size() * (part.size() - 1));
  EXPECT_EQ(world().ranks_of_node().size(), ranks) << "the test runs on one machine";
}

TEST(Communicator, TheFirstRankWorksAloneAndItsErrorIsThrownOnAll) {
  int done = 0;
  world().on_first([&] { ++done; });
  EXPECT_EQ(done, world().is_root() ? 1 : 0);
  EXPECT_THROW(world().on_first([] { throw InputError("of the first rank"); }), InputError);
}

TEST(Communicator, MessagesGoInPiecesOfAnySize) {
  std::vector<std::vector<std::byte>> out(world().size()), in(world().size());
  std::vector<Communicator::Outgoing> outgoing;
  std::vector<Communicator::Incoming> incoming;
  for (int other = 0; other < world().size(); ++other) {
    out[other].assign(13 + static_cast<std::size_t>(other), static_cast<std::byte>(world().rank()));
    in[other].resize(13 + static_cast<std::size_t>(world().rank()));
    outgoing.push_back({other, out[other]});
    incoming.push_back({other, in[other]});
  }
  world().exchange_messages(outgoing, incoming, 5);
  for (int other = 0; other < world().size(); ++other)
    EXPECT_EQ(in[other], std::vector<std::byte>(in[other].size(), static_cast<std::byte>(other)));
}

TEST(Morton, InterleavesTheBits) {
  EXPECT_EQ(morton_key(0, 0), 0U);
  EXPECT_EQ(morton_key(1, 0), 1U);
  EXPECT_EQ(morton_key(0, 1), 2U);
  EXPECT_EQ(morton_key(0b101, 0b011), 0b011011U);
  EXPECT_EQ(morton_key(0xffffffff, 0), 0x5555555555555555U);
  EXPECT_EQ(morton_key(0, 0xffffffff), 0xaaaaaaaaaaaaaaaaU);
  for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(spread_bits(1U << bit), std::uint64_t{1} << 2 * bit);
}

TEST(StageTimes, OfOneNameAreAddedUp) {
  const StageSeconds sums = added_up({{"write", 1}, {"solve", 2}, {"write", 4}});
  EXPECT_EQ(sums, (StageSeconds{{"write", 5}, {"solve", 2}}));
  EXPECT_TRUE(added_up({}).empty());
}

TEST(StageTimes, StandInTheirOrder) {
  StageTimes times, more;
  times.end();  // none is under way
  times.begin("mesh");
  times.begin("smooth");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  more.begin("mesh");
  more.end();
  const double once = more.stages().front().second;
  more.end();
  EXPECT_EQ(more.stages().front().second, once);
  times.append(more);
  std::string names;
  for (const auto& [stage, seconds] : times.stages()) names += stage + " ";
  EXPECT_EQ(names, "mesh smooth mesh ");
  EXPECT_GE(times.stages()[1].second, 0.02);
  EXPECT_EQ(times.stages()[2].second, once);
}

}  // namespace
}  // namespace quadloop
