// Forests, shared out: the same leaves on any number of ranks, and all that touch them at hand.
#include "mesher/forest/forest.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/forest/curve_owners.hpp"
#include "mesher/forest/leaf_exchange.hpp"
#include "tests/forest/brick.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::brick;

/// Refined towards a point, without a jump in level where leaves touch.
bool near_point(const Quadrant& q) {
  constexpr Quadrant place{(std::int64_t{3} << 29) + 5, (std::int64_t{1} << 30) - 7, Quadrant::unit_level};
  return chebyshev_gap(q, place) < q.size();
}

Forest graded_brick() {
  Forest forest(test::world(), brick);
  forest.refine(near_point, 6);
  forest.partition();
  return forest;
}

std::vector<Quadrant> all_leaves(const Forest& forest) {
  return test::world().all_gather_values(std::span<const Quadrant>(forest.leaves()));
}

/// The same without a forest: Morton order in each tree; of the trees it tells nothing.
void leaves_below(const Quadrant& q, int deepest, std::vector<Quadrant>& leaves) {
  if (q.level > 0 && (q.level == deepest || !near_point(q))) {
    leaves.push_back(q);
    return;
  }
  for (const Corner quarter : corners_along_curve) leaves_below(q.child(quarter), deepest, leaves);
}

TEST(Forest, IsRefinedInTheOrderOfTheCurve) {
  const auto all = all_leaves(graded_brick());
  std::size_t expected = 0;
  for (std::int64_t y = 0; y < 2; ++y) {
    for (std::int64_t x = 0; x < 3; ++x) {
      const Quadrant tree{x << Quadrant::unit_level, y << Quadrant::unit_level, 0};
      std::vector<Quadrant> below;
      leaves_below(tree, 6, below);
      expected += below.size();
      std::vector<Quadrant> own;
      std::copy_if(all.begin(), all.end(), std::back_inserter(own),
                   [&](const Quadrant& q) { return tree.contains(q); });
      EXPECT_EQ(own, below);
    }
  }
  EXPECT_EQ(all.size(), expected);
}

TEST(Forest, IsRefinedFurtherOnceItIsSharedOut) {
  Forest forest(test::world(), brick);
  forest.refine(near_point, 3);
  forest.partition();
  for (const int deepest : {4, 6}) forest.refine(near_point, deepest);  // among leaves of many levels
  EXPECT_EQ(all_leaves(forest), all_leaves(graded_brick()));
}

TEST(Forest, SplitsWhatIsMarkedOnce) {
  Forest forest(test::world(), brick);
  std::vector<char> marked;
  for (const Quadrant& q : forest.leaves()) marked.push_back(q.x == 0 && q.y == 0 ? 1 : 0);
  const auto before = test::world().sum(forest.local_leaves());
  forest.split_marked(marked);
  EXPECT_EQ(test::world().sum(forest.local_leaves()), before + 3);
  forest.split_marked(std::vector<char>(forest.leaves().size(), 0));
  EXPECT_EQ(test::world().sum(forest.local_leaves()), before + 3);
  for (const Quadrant& q : all_leaves(forest)) EXPECT_EQ(q.level, q.x < 1 << 29 && q.y < 1 << 29 ? 2 : 1);
}

TEST(Forest, PartitionSharesOutEvenlyAndKeepsTheCurve) {
  Forest forest(test::world(), brick);
  forest.refine(near_point, 6);
  const auto before = all_leaves(forest);
  forest.partition();
  EXPECT_EQ(all_leaves(forest), before);
  const std::int64_t least = test::world().minimum(std::int64_t{forest.local_leaves()});
  const std::int64_t most = test::world().maximum(std::int64_t{forest.local_leaves()});
  EXPECT_LE(most - least, 1);
}

TEST(Forest, PartitionByWeightSharesOutTheWeight) {
  Forest forest(test::world(), brick);
  forest.refine(near_point, 7);
  const auto weight = [](const Quadrant& q) { return q.level == 7 ? 16 : 1; };
  const auto before = all_leaves(forest);
  forest.partition(weight);
  EXPECT_EQ(all_leaves(forest), before);
  std::int64_t own = 0, all = 0;
  for (const Quadrant& q : forest.leaves()) own += weight(q);
  for (const Quadrant& q : before) all += weight(q);
  EXPECT_NEAR(static_cast<double>(own), static_cast<double>(all) / test::world().size(), 16);
}

TEST(CurveOwners, KnowWhoseEveryLeafIs) {
  const Forest forest = graded_brick();
  const CurveOwners owners = forest.owners();
  EXPECT_EQ(owners.ranks(), static_cast<std::size_t>(test::world().size()));
  const auto counts = test::world().all_gather(forest.local_leaves());
  std::vector<int> rank_of;
  for (int rank = 0; rank < test::world().size(); ++rank) rank_of.insert(rank_of.end(), counts[rank], rank);
  const auto all = all_leaves(forest);
  CurveKey before{-1, 0};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CurveKey key = owners.key_at(all[i].x, all[i].y);
    EXPECT_LT(before, key) << "the curve goes on";
    before = key;
    EXPECT_EQ(owners.rank_of(key), rank_of[i]);
    const std::int64_t last = all[i].size() - 1;
    EXPECT_EQ(owners.rank_of(owners.key_at(all[i].x + last, all[i].y + last)), rank_of[i]);
    for (int rank = 0; rank < test::world().size(); ++rank)
      EXPECT_EQ(owners.owns(rank, key), rank == rank_of[i]);
  }
}

TEST(CurveOwners, ARankWithoutLeavesOwnsNothing) {
  const CurveOwners owners({{0, 0}, {0, 8}, {0, 8}, {1, 0}}, {0}, 1);
  EXPECT_EQ(owners.rank_of({0, 7}), 0);
  EXPECT_EQ(owners.rank_of({0, 8}), 2);
  EXPECT_FALSE(owners.owns(1, {0, 8}));
  EXPECT_TRUE(owners.owns(2, {0, 8}));
}

TEST(LeafExchange, BringsWhatTheOwnersKnow) {
  const Forest forest = graded_brick();
  const LeafGraph graph(test::world(), brick, forest);
  const auto truth = [](const Quadrant& q) { return q.x + 3 * q.y + q.level; };
  std::vector<std::int64_t> rows;
  for (const LeafId leaf : graph.all()) {
    rows.push_back(graph.is_local(leaf) ? truth(graph.leaf(leaf)) : -1);
    rows.push_back(graph.is_local(leaf) ? graph.leaf(leaf).level : -1);
  }
  LeafExchange(test::world(), graph).update_rows(rows, 2);
  for (const LeafId leaf : graph.all()) {
    EXPECT_EQ(rows[2 * leaf.value()], truth(graph.leaf(leaf)));
    EXPECT_EQ(rows[2 * leaf.value() + 1], graph.leaf(leaf).level);
  }
}

TEST(TouchingLeaves, AreAllThatTouchByAnEdgeOrACorner) {
  const Forest forest = graded_brick();
  const LeafGraph graph(test::world(), brick, forest);
  LeafFinder finder(graph);
  for (const LeafId leaf : graph.local()) {
    std::vector<LeafId> found, expected;
    for_touching_leaves(finder, leaf, [&](LeafId other) { found.push_back(other); });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const LeafId other : graph.all()) {
      if (other != leaf && chebyshev_gap(graph.leaf(leaf), graph.leaf(other)) == 0) expected.push_back(other);
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace quadloop
