// What adaptation asks to split: every rank knows all of it, the tree follows, and what was asked for can be
// read off the leaves again.
#include "mesher/sizes/demanded_splits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr std::int64_t tree_edge = std::int64_t{1} << Quadrant::unit_level;
using Place = std::tuple<int, std::int64_t, std::int64_t>;  ///< level, then the corner

Place place_of(const Quadrant& q, int level) {
  const std::int64_t mask = ~((std::int64_t{1} << (Quadrant::unit_level - level)) - 1);
  return {level, q.x & mask, q.y & mask};
}

/// Random leaves of a brick of 3 x 2 trees, with random levels to split at or above each.
std::vector<SplitDemand> random_demands(int count) {
  std::mt19937_64 random(11);
  std::vector<SplitDemand> demands;
  for (int i = 0; i < count; ++i) {
    const int level = static_cast<int>(random() % 12);
    const std::int64_t size = std::int64_t{1} << (Quadrant::unit_level - level);
    const auto coordinate = [&](std::int64_t trees) {
      return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(trees * tree_edge)) / size *
             size;
    };
    const Quadrant leaf{coordinate(3), coordinate(2), level};
    demands.push_back({leaf, static_cast<std::uint32_t>(random()) & ((2U << level) - 1)});
  }
  return demands;
}

std::vector<SplitDemand> share_of(const std::vector<SplitDemand>& all) {
  std::vector<SplitDemand> share;
  for (std::size_t i = static_cast<std::size_t>(world().rank()); i < all.size();
       i += static_cast<std::size_t>(world().size()))
    share.push_back(all[i]);
  return share;
}

/// The number of a quadrant if it is split, found from its tree's root downwards.
std::int32_t number_of(const DemandedSplits& splits, const Quadrant& q) {
  std::int32_t number = splits.root(q.x / tree_edge, q.y / tree_edge);
  for (int level = 0; number != DemandedSplits::none && level < q.level; ++level) {
    const int shift = Quadrant::unit_level - 1 - level;
    number = splits.child(number, corner_at((q.x >> shift & 1) != 0, (q.y >> shift & 1) != 0));
  }
  return number;
}

TEST(DemandedSplits, NoneAskForNothing) {
  const DemandedSplits none, empty(world(), {});
  for (const DemandedSplits* splits : {&none, &empty}) {
    EXPECT_TRUE(splits->empty());
    EXPECT_EQ(splits->root(0, 0), DemandedSplits::none);
    EXPECT_EQ(DemandPath(*splits).levels_above({0, 0, 5}), 0U);
    EXPECT_EQ(splits->finest_level(), 0);
  }
}

TEST(DemandedSplits, HoldWhatWasAskedForAndAllAbove) {
  const auto demands = random_demands(400);
  const DemandedSplits splits(world(), share_of(demands));
  std::set<Place> asked, split;
  int deepest = -1;
  for (const auto& [leaf, levels] : demands) {
    for (int level = 0; level <= leaf.level; ++level) {
      if ((levels >> level & 1) == 0) continue;
      asked.insert(place_of(leaf, level));
      deepest = std::max(deepest, level);
      for (int above = 0; above <= level; ++above) split.insert(place_of(leaf, above));
    }
  }
  EXPECT_EQ(splits.finest_level(), deepest + 1);
  DemandPath path(splits);
  for (const auto& [leaf, levels] : demands) {
    std::uint32_t expected = 0;
    for (int level = 0; level < leaf.level; ++level)
      expected |= asked.contains(place_of(leaf, level)) ? 1U << level : 0U;
    EXPECT_EQ(path.levels_above(leaf), expected);
    for (int level = 0; level <= leaf.level; ++level) {
      const auto [l, x, y] = place_of(leaf, level);
      const std::int32_t number = number_of(splits, {x, y, l});
      EXPECT_EQ(number != DemandedSplits::none, split.contains(place_of(leaf, level)));
      if (number == DemandedSplits::none) continue;
      int finest = 0;
      for (const auto& [deep, deep_x, deep_y] : asked) {
        const Quadrant inside{deep_x, deep_y, deep};
        if (Quadrant{x, y, l}.contains(inside)) finest = std::max(finest, deep + 1);
      }
      EXPECT_EQ(splits.finest_level_in(number), finest);
    }
  }
}

TEST(DemandedSplits, NumbersAreThoseOfOneQuadrantEach) {
  const auto demands = random_demands(300);
  const DemandedSplits splits(world(), share_of(demands));
  std::map<std::int32_t, Place> place_of_number;
  for (const auto& [leaf, levels] : demands) {
    for (int level = 0; level <= leaf.level; ++level) {
      const auto [l, x, y] = place_of(leaf, level);
      const std::int32_t number = number_of(splits, {x, y, l});
      if (number == DemandedSplits::none) continue;
      EXPECT_EQ(place_of_number.emplace(number, place_of(leaf, level)).first->second, place_of(leaf, level));
    }
  }
  EXPECT_GT(world().sum(std::ssize(place_of_number)), 300);
}

TEST(DemandedSplits, BesideOthersAreThoseOfBoth) {
  const auto demands = random_demands(300);
  const std::vector<SplitDemand> some(demands.begin(), demands.begin() + 100),
      more(demands.begin() + 60, demands.end());
  const DemandedSplits before(world(), share_of(some)), both(world(), share_of(more), before),
      at_once(world(), share_of(demands));
  EXPECT_EQ(both.finest_level(), at_once.finest_level());
  DemandPath path(both), expected(at_once);
  for (const auto& [leaf, levels] : demands) {
    EXPECT_EQ(path.levels_above(leaf), expected.levels_above(leaf));
    EXPECT_EQ(number_of(both, leaf), number_of(at_once, leaf));
  }
}

}  // namespace
}  // namespace quadloop
