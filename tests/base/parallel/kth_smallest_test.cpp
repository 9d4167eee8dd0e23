// The k-th smallest of values that the ranks share, against sorting all of them.
#include "mesher/base/parallel/kth_smallest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

TEST(KthSmallest, IsThatOfAllRanksValues) {
  std::mt19937_64 random(3);
  std::vector<double> all, own;
  for (int i = 0; i < 1000; ++i) {
    const auto value = static_cast<double>(random() % 300);  // many are equal
    const bool mine = static_cast<int>(random() % 7) % world().size() == world().rank();
    all.push_back(value);
    if (mine) own.push_back(value);
  }
  std::ranges::sort(all);
  for (const std::int64_t k : {1, 2, 500, 990, 991, 1000})
    EXPECT_EQ(kth_smallest(world(), own, k), all[k - 1]) << k;
}

TEST(KthSmallest, OfOneRanksValuesAndInfinity) {
  std::vector<double> own;
  if (world().is_root()) own = {std::numeric_limits<double>::infinity(), 0, 2};
  EXPECT_EQ(kth_smallest(world(), own, 2), 2);
  EXPECT_EQ(kth_smallest(world(), own, 3), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace quadloop
