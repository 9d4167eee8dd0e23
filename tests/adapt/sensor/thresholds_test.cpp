// Flags by each rule: worked out by hand, nothing where nothing differs, equal leaves alike, the
// same on any number of ranks.
#include "adapt/sensor/thresholds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;
using Values = std::vector<double>;
using RefinementFlags = std::vector<RefinementFlag>;

constexpr RefinementFlag down = RefinementFlag::coarsen, keep = RefinementFlag::keep,
                         up = RefinementFlag::refine;

/// The marks of all leaves; the values of leaves without cells are below 0 here.
test::RuledFlags flag_all(const Values& values, const ThresholdRule& rule,
                          test::Sharing sharing = test::Sharing::uneven) {
  Values own = test::share_of(values, sharing);
  std::vector<LeafRecord> leaves;
  for (double& value : own) {
    leaves.push_back(value < 0 ? LeafRecord{} : test::leaf_with(2, 0));
    value = std::max(value, 0.0);
  }
  test::RuledFlags ruled = test::flags_by(rule, world(), leaves, own);
  ruled.flags = test::joined(world(), ruled.flags);
  return ruled;
}

TEST(Thresholds, DeviationIsThatOfTheLogarithms) {
  // log10 0, 1, 2, 3: mean 1.5, deviation sqrt(5/4) = 1.118.
  const test::RuledFlags all = flag_all({1000, 1, 10, -1, 100}, DeviationRule{1, 0.5});
  EXPECT_NEAR(all.statistics.mean, 1.5, 1e-15);
  EXPECT_NEAR(all.statistics.deviation, std::sqrt(1.25), 1e-15);
  EXPECT_NEAR(all.thresholds.refine, std::pow(10, 1.5 + std::sqrt(1.25)), 1e-10);
  EXPECT_NEAR(all.thresholds.coarsen, std::pow(10, 1.5 - 0.5 * std::sqrt(1.25)), 1e-12);
  EXPECT_EQ(all.flags, (RefinementFlags{up, down, keep, keep, keep}));
  EXPECT_EQ(all.refined, 1);
  EXPECT_EQ(all.coarsened, 1);
  EXPECT_EQ(flag_all({1000, 1, 10, -1, 100}, DeviationRule{0.4, 1.4}).flags,
            (RefinementFlags{up, keep, keep, keep, up}));
}

TEST(Thresholds, SmallIndicatorsCountAsAMillionthOfTheLargest) {
  // log10 -6, -6, 0, -3 of the largest, which is 8: mean -3.75, deviation 2.487.
  const double log_largest = std::log10(8.0);
  const test::RuledFlags all = flag_all({0, 1e-12, 8, 8e-3}, DeviationRule{1, 0.5});
  EXPECT_NEAR(all.statistics.mean, log_largest - 3.75, 1e-14);
  EXPECT_NEAR(all.statistics.deviation, std::sqrt((2 * 2.25 * 2.25 + 3.75 * 3.75 + 0.75 * 0.75) / 4), 1e-14);
  EXPECT_EQ(all.flags, (RefinementFlags{down, down, up, keep}));
  // Where the threshold lies below the millionth no leaf lies below it, one of indicator 0 neither.
  EXPECT_EQ(flag_all({0, 1e-12, 8, 8e-3}, DeviationRule{1, 1}).flags,
            (RefinementFlags{keep, keep, up, keep}));
  // And all lie above it.
  EXPECT_EQ(flag_all({0, 1e-12, 8, 8e-3}, DeviationRule{-1, 1}).flags, (RefinementFlags{up, up, up, up}));
}

TEST(Thresholds, WhatIsEqualIsNotMarked) {
  const ThresholdRule rules[] = {DeviationRule{0, 0}, DeviationRule{}, FractionRule{0.5, 0.5}, NodesRule{0}};
  for (const ThresholdRule& rule : rules) {
    for (const double value : {0.0, 0.1, 1e-300, 1e300}) {
      const test::RuledFlags all = flag_all(Values(7, value), rule);
      EXPECT_EQ(all.flags, RefinementFlags(7, keep)) << value;
      EXPECT_EQ(all.refined + all.coarsened, 0);
      EXPECT_TRUE(std::isfinite(all.statistics.mean) && std::isfinite(all.statistics.deviation));
    }
    EXPECT_EQ(flag_all({0.1, 0.1 * (1 + 1e-12), 0.1 * (1 - 1e-12)}, rule).flags, RefinementFlags(3, keep))
        << "rounding is no difference";
    EXPECT_EQ(flag_all({-1, 0.3, -1}, rule).flags, RefinementFlags(3, keep));
    EXPECT_EQ(flag_all({-1, -1}, rule).flags, RefinementFlags(2, keep));
    EXPECT_TRUE(flag_all({}, rule).flags.empty());
  }
}

TEST(Thresholds, FractionCountsLeavesWithCells) {
  const Values values{5, -1, 3, 9, 1, 7, -1, 2, 8, 4, 6, 10};
  EXPECT_EQ(flag_all(values, FractionRule{0.2, 0.3}).flags,
            (RefinementFlags{keep, keep, down, up, down, keep, keep, down, keep, keep, keep, up}));
  const test::RuledFlags none = flag_all(values, FractionRule{0, 0});
  EXPECT_EQ(none.refined + none.coarsened, 0);
  const test::RuledFlags all = flag_all(values, FractionRule{1, 1});  // refining comes first
  EXPECT_EQ(all.refined, 10);
  EXPECT_EQ(all.coarsened, 0);
}

TEST(Thresholds, FractionTreatsEqualLeavesAlike) {
  EXPECT_EQ(flag_all({2, 3, 3, 1, 2, 1, 3, 1, 2, 2}, FractionRule{0.1, 0.1}).flags,
            (RefinementFlags{keep, up, up, down, keep, down, up, down, keep, keep}));
  EXPECT_EQ(flag_all({0, 0, 0, 1, 0}, FractionRule{0.6, 0.2}).flags,
            (RefinementFlags{down, down, down, up, down}));
}

TEST(Thresholds, NodesRuleCoarsensAlone) {
  const test::RuledFlags all = flag_all({1, 10, 100, 1000}, NodesRule{0.5});
  EXPECT_EQ(all.flags, (RefinementFlags{down, keep, keep, keep}));
  EXPECT_EQ(all.thresholds.coarsen, flag_all({1, 10, 100, 1000}, DeviationRule{}).thresholds.coarsen);
}

/// As a caller does who wants a number of nodes: more leaves by a larger share.
TEST(Thresholds, AShareCanBeBisected) {
  Values values;
  for (int i = 0; i < 500; ++i) values.push_back(std::pow(10, 3 * test::scattered(3, i, 0)));
  const Values own = test::share_of(values, test::Sharing::even);
  const std::vector<LeafRecord> leaves(own.size(), test::leaf_with(1, 0));
  const OrderedValues ordered(world(), leaves, own);
  for (const std::int64_t wanted : {1, 137, 499}) {
    const double share = static_cast<double>(wanted) / 500;
    const RefinementFlags flags = flags_above(leaves, own, {ordered.refine_threshold(share), 0});
    EXPECT_EQ(count_of(world(), flags, up), wanted);
    EXPECT_EQ(count_of(world(), flags, down), 0);
  }
}

TEST(Thresholds, AreTheSameOnAnyNumberOfRanks) {
  Values values;
  for (int i = 0; i < 997; ++i)
    values.push_back(i % 7 == 0 ? -1 : std::pow(10, 5 * test::scattered(4, i % 400, 0)));
  std::vector<LeafRecord> leaves;
  Values whole;
  for (const double value : values) {
    leaves.push_back(value < 0 ? LeafRecord{} : test::leaf_with(2, 0));
    whole.push_back(std::max(value, 0.0));
  }
  for (const ThresholdRule& rule : {ThresholdRule{DeviationRule{}}, ThresholdRule{FractionRule{0.15, 0.25}},
                                    ThresholdRule{NodesRule{}}}) {
    const test::RuledFlags expected = test::flags_by(rule, Communicator(MPI_COMM_SELF), leaves, whole);
    EXPECT_GT(expected.coarsened, 0);
    for (const test::Sharing sharing : test::all_sharings) {
      const test::RuledFlags found = flag_all(values, rule, sharing);
      EXPECT_EQ(found.flags, expected.flags);
      EXPECT_EQ(found.statistics.mean, expected.statistics.mean);
      EXPECT_EQ(found.statistics.deviation, expected.statistics.deviation);
      EXPECT_EQ(found.thresholds.refine, expected.thresholds.refine);
      EXPECT_EQ(found.thresholds.coarsen, expected.thresholds.coarsen);
      EXPECT_EQ(found.refined, expected.refined);
    }
  }
}

}  // namespace
}  // namespace quadloop::adapt
