// The k-th of all ranks' values, and thresholds that leave a share above or below them, against a sorted
// list.
#include "adapt/sensor/ordered_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/infinite.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::infinite;
using test::world;
using Values = std::vector<double>;

/// Values of leaves with a cell each, and this rank's share of them.
OrderedValues ordered(const Values& values, test::Sharing sharing = test::Sharing::even) {
  const Values own = test::share_of(values, sharing);
  const std::vector<LeafRecord> leaves(own.size(), test::leaf_with(0, 1));
  return {world(), leaves, own};
}

/// Many sizes, many ties, zeros of both signs, the smallest and the largest double.
Values mixed_values() {
  Values values{0, -0.0, 0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()};
  for (int i = 0; i < 200; ++i) values.push_back(std::ldexp(std::abs(test::scattered(2, i, 0)), i % 40 - 20));
  for (int i = 0; i < 100; ++i) values.push_back(1 + i % 3);
  return values;
}

std::int64_t count_above(const Values& values, double threshold) {
  return std::count_if(values.begin(), values.end(), [&](double value) { return value > threshold; });
}
std::int64_t count_below(const Values& values, double threshold) {
  return std::count_if(values.begin(), values.end(), [&](double value) { return value < threshold; });
}

TEST(OrderedValues, FindTheKth) {
  Values sorted = mixed_values();
  const Values values = sorted;
  std::sort(sorted.begin(), sorted.end());
  for (const test::Sharing sharing : test::all_sharings) {
    const OrderedValues all = ordered(values, sharing);
    ASSERT_EQ(all.count(), std::ssize(values));
    EXPECT_EQ(all.smallest(), 0);
    EXPECT_EQ(all.largest(), sorted.back());
    for (std::int64_t k = 1; k <= all.count(); k += 19) {
      EXPECT_EQ(all.kth_smallest(k), sorted[k - 1]);
      EXPECT_EQ(all.kth_largest(k), sorted[sorted.size() - static_cast<std::size_t>(k)]);
    }
  }
}

TEST(OrderedValues, ThresholdsOfSharesAreExactAndSplitNoTies) {
  const Values values = mixed_values();
  const OrderedValues all = ordered(values);
  double last_refine = infinite, last_coarsen = 0;
  for (int percent = 0; percent <= 100; percent += 10) {
    const auto count = std::llround(percent * 0.01 * static_cast<double>(values.size()));
    const double refine = all.refine_threshold(percent * 0.01),
                 coarsen = all.coarsen_threshold(percent * 0.01);
    EXPECT_LE(refine, last_refine);
    EXPECT_GE(coarsen, last_coarsen);
    const std::int64_t above = count_above(values, refine), below = count_below(values, coarsen);
    if (refine > 0) {
      EXPECT_GE(above, count);  // no fewer, and without the last of them and its equals too few
      if (count > 0) {
        EXPECT_LT(count_above(values, std::nextafter(refine, infinite)), count);
      }
    }
    EXPECT_GE(below, count);
    if (count > 0) {
      EXPECT_LT(count_below(values, std::nextafter(coarsen, 0)), count);
    }
    last_refine = refine;
    last_coarsen = coarsen;
  }
}

TEST(OrderedValues, NoShareRefinesZeros) {
  const Values values{0, 0, 0, 2, 0, 1, 0, 0};
  EXPECT_EQ(count_above(values, ordered(values).refine_threshold(1)), 2);
  EXPECT_EQ(count_above(values, ordered(values).refine_threshold(0)), 0);
  EXPECT_EQ(count_above(values, ordered(values).refine_threshold(0.125)), 1);
  EXPECT_EQ(count_below(values, ordered(values).coarsen_threshold(0.125)), 6);
  EXPECT_EQ(count_below(values, ordered(values).coarsen_threshold(0)), 0);
}

TEST(OrderedValues, LeaveOutLeavesWithoutCells) {
  const std::vector<LeafRecord> leaves{test::leaf_with(1, 0), {}, test::leaf_with(0, 2)};
  const OrderedValues all(world(), leaves, Values{3, 0, 2});
  EXPECT_EQ(all.count(), 2 * world().size());
  EXPECT_EQ(all.smallest(), 2);
  EXPECT_EQ(all.largest(), 3);
}

TEST(OrderedValues, MayBeNone) {
  const OrderedValues none = ordered({});
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.largest(), 0);
  EXPECT_EQ(none.refine_threshold(0.5), infinite);
  EXPECT_EQ(none.coarsen_threshold(0.5), 0);
}

TEST(OrderedValues, AreFiniteAndNotNegative) {
  EXPECT_THROW(ordered({1, 2, std::numeric_limits<double>::quiet_NaN()}), Fault);
  EXPECT_THROW(ordered({1, infinite, 2}), Fault);
  EXPECT_THROW(ordered({-1, 1, 2}), Fault);
}

}  // namespace
}  // namespace quadloop::adapt
