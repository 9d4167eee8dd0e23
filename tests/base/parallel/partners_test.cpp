// Items find each other by their keys, on whatever ranks they are.
#include "mesher/base/parallel/partners.hpp"

#include <gtest/gtest.h>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// Item i of all looks for 99 - i; those that 7 divides are absent.
TEST(Partners, AreFoundWhereTheyAre) {
  const auto is_there = [](std::uint64_t i) { return i % 7 != 0; };
  const auto rank_of = [](std::uint64_t i) { return static_cast<int>(i * i) % world().size(); };
  std::vector<PairKey<1>> keys;
  std::vector<std::int64_t> number(100, -1), next(world().size(), 0);
  for (std::uint64_t i = 0; i < 100; ++i) {
    if (!is_there(i)) continue;
    number[i] = next[rank_of(i)]++;
    if (rank_of(i) == world().rank()) keys.push_back({{i}, {99 - i}});
  }
  const std::vector<Partner> partners = find_partners<1>(world(), keys);
  ASSERT_EQ(partners.size(), keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::uint64_t partner = keys[i].partner[0];
    EXPECT_EQ(partners[i].found(), is_there(partner));
    if (!is_there(partner)) continue;
    EXPECT_EQ(partners[i].rank, rank_of(partner));
    EXPECT_EQ(partners[i].item, number[partner]);
  }
}

TEST(Partners, MayBeTheItemItself) {
  const std::uint64_t own = world().rank();
  const std::vector<PairKey<2>> keys{{{1, own}, {1, own}}};
  const std::vector<Partner> partners = find_partners<2>(world(), keys);
  EXPECT_EQ(partners[0].rank, world().rank());
  EXPECT_EQ(partners[0].item, 0);
}

}  // namespace
}  // namespace quadloop
