#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesher/forest/leaf_finder.hpp"
#include "tests/forest/brick.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::brick;

/// A brick of 3 by 2 trees, refined towards one point.
Forest refined_brick(const TreeGrid& grid) {
  Forest forest(test::world(), grid);
  forest.refine(
      [](const Quadrant& q) {
        return q.level < 2 ||
               (q.contains({(std::int64_t{3} << 29) + 5, (std::int64_t{1} << 30) - 7, 30}) && q.level < 6);
      },
      6);
  forest.refine([](const Quadrant& q) { return q.level < 4; },
                4);  // levels 4 to 6: touching leaves may differ by two, which the graph must stand
  forest.partition();
  return forest;
}

TEST(LeafGraph, PointsFindTheirLeaves) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  for (const LeafId leaf : graph.all()) {
    const Quadrant& q = graph.leaf(leaf);
    EXPECT_EQ(graph.leaf_at(q.x, q.y), leaf);
    EXPECT_EQ(graph.leaf_at(q.x + q.size() - 1, q.y + q.size() - 1), leaf);
  }
  EXPECT_EQ(graph.leaf_at(-1, 0), LeafGraph::none);
  EXPECT_EQ(graph.leaf_at(0, std::int64_t{2} << 30), LeafGraph::none);
}

TEST(LeafFinder, WhereItLookedBeforeMakesNoDifference) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  LeafFinder finder(graph);
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> column(-2, (std::int64_t{3} << 30) + 1),
      step(-40000000, 40000000);
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t x = column(random), y = column(random);
    EXPECT_EQ(finder.leaf_at(x, y), graph.leaf_at(x, y));
    const std::int64_t near_x = x + step(random), near_y = y + step(random);
    EXPECT_EQ(finder.leaf_at(near_x, near_y), graph.leaf_at(near_x, near_y));
  }
}

TEST(LeafFinder, ACornersLeavesAreTheFourSquaresRoundIt) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  LeafFinder finder(graph);
  for (const LeafId leaf : graph.all()) {
    const Quadrant& q = graph.leaf(leaf);
    const std::array<LeafId, 4> expected{graph.leaf_at(q.x - 1, q.y - 1), graph.leaf_at(q.x, q.y - 1), leaf,
                                         graph.leaf_at(q.x - 1, q.y)};
    EXPECT_EQ(finder.leaves_round({q.x, q.y}), expected);
  }
}

TEST(LeafGraph, NeighboursAreTheLeavesThatTouch) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  for (const LeafId leaf : graph.local()) {
    const Quadrant& q = graph.leaf(leaf);
    const std::int64_t last = q.size() - 1;
    const auto& around = graph.around(leaf);
    EXPECT_EQ(around.south_west, graph.leaf_at(q.x - 1, q.y - 1));
    EXPECT_EQ(around.south, graph.leaf_at(q.x + last, q.y - 1));
    EXPECT_EQ(around.west, graph.leaf_at(q.x - 1, q.y + last));
    const auto finer = [&](LeafId other) {
      return other != LeafGraph::none && graph.leaf(other).level > q.level;
    };
    EXPECT_EQ(graph.has_hanging(leaf, Side::right), finer(graph.leaf_at(q.x + q.size(), q.y)));
    EXPECT_EQ(graph.has_hanging(leaf, Side::top), finer(graph.leaf_at(q.x, q.y + q.size())));
    EXPECT_EQ(graph.has_hanging(leaf, Side::left), finer(around.west));
    EXPECT_EQ(graph.has_hanging(leaf, Side::bottom), finer(around.south));
  }
}

TEST(LeafGraph, EarlierNeighboursComeEarlierAlongTheCurve) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  for (const LeafId leaf : graph.all()) {
    for (const LeafId before :
         {graph.around(leaf).south_west, graph.around(leaf).south, graph.around(leaf).west})
      EXPECT_LT(before, leaf);
  }
}

TEST(LeafGraph, KnowsTheRankOfLeavesOutOfSight) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  std::vector<std::pair<Quadrant, int>> all;
  for (const Quadrant& q : test::world().all_gather_values(std::span<const Quadrant>(forest.leaves())))
    all.emplace_back(q, graph.rank_at(q.x, q.y));
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; }));
  const auto own = std::count_if(all.begin(), all.end(),
                                 [](const auto& leaf) { return leaf.second == test::world().rank(); });
  EXPECT_EQ(own, forest.local_leaves());
  for (const Quadrant& q : forest.leaves()) {
    EXPECT_EQ(graph.rank_at(q.x, q.y), test::world().rank());
    EXPECT_EQ(graph.rank_at(q.x + q.size() - 1, q.y + q.size() - 1), test::world().rank());
  }
}

TEST(LeafGraph, LocalLeavesHaveAnIndexAndGhostsHaveNone) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  std::int32_t leaves = 0, local = 0;
  for (const LeafId leaf : graph.all()) {
    EXPECT_EQ(leaf, LeafId{leaves++});
    const bool in_range = leaf.value() >= graph.local_begin() && local < graph.local_size();
    EXPECT_EQ(graph.is_local(leaf), in_range);
    if (!graph.is_local(leaf)) continue;
    EXPECT_EQ(graph.local_index(leaf), local);
    EXPECT_EQ(graph.from_local(local++), leaf);
  }
  EXPECT_EQ(leaves, graph.size());
  EXPECT_EQ(local, graph.local_size());
  for (const LeafId leaf : graph.local()) local -= graph.is_local(leaf) ? 1 : 0;
  EXPECT_EQ(local, 0);
  EXPECT_FALSE(graph.is_local(LeafGraph::none));
}

TEST(LeafGraph, LeavesKnowTheirOwners) {
  const Forest forest = refined_brick(brick);
  const LeafGraph graph(test::world(), brick, forest);
  std::vector<Quadrant> local;
  for (const LeafId leaf : graph.local()) local.push_back(graph.leaf(leaf));
  const auto counts = test::world().all_gather(std::ssize(local));
  const auto all = test::world().all_gather_values(std::span<const Quadrant>(local));
  for (const LeafId leaf : graph.all()) {
    const LeafGraph::Owner owner = graph.owner_of(leaf);
    std::int64_t at = owner.index;
    for (int rank = 0; rank < owner.rank; ++rank) at += counts[rank];
    EXPECT_EQ(all[at], graph.leaf(leaf));
  }
}

}  // namespace
}  // namespace quadloop
