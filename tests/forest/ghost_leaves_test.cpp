// What a rank knows of others: all their leaves that touch one of its own, and no more.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mesher/forest/ghost_layer.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "tests/forest/brick.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::brick;

using Place = std::array<std::int64_t, 5>;  ///< x, y, level; rank, number there

Place place_of(const Quadrant& q, int rank, std::int32_t index) { return {q.x, q.y, q.level, rank, index}; }

/// The leaves of all ranks. *Collective.*
std::vector<Place> all_places(const Forest& forest) {
  std::vector<Place> own;
  for (const Quadrant& q : forest.leaves())
    own.push_back(place_of(q, test::world().rank(), static_cast<std::int32_t>(own.size())));
  return test::world().all_gather_values(std::span<const Place>(own));
}

void expect_ghosts(const TreeGrid& grid, const Forest& forest) {
  const LeafGraph graph(test::world(), grid, forest);
  const auto own = forest.leaves();
  std::vector<Place> known, expected;
  for (const LeafId leaf : graph.all()) {
    const auto [rank, index] = graph.owner_of(leaf);
    known.push_back(place_of(graph.leaf(leaf), rank, index));
  }
  for (const Place& p : all_places(forest)) {
    const Quadrant q{p[0], p[1], static_cast<int>(p[2])};
    const bool near = std::any_of(own.begin(), own.end(),
                                  [&](const Quadrant& other) { return chebyshev_gap(q, other) == 0; });
    if (near) expected.push_back(p);
  }
  EXPECT_EQ(known, expected) << "in the order of the curve";
  EXPECT_EQ(graph.local_size(), std::ssize(own));
}

TEST(GhostLeaves, AreThoseThatTouchOwnOnes) {
  for (const std::int64_t towards : {5L, 1L << 29, (1L << 30) - 7, (1L << 30) + (1L << 28)}) {
    Forest forest(test::world(), brick);
    forest.refine(
        [&](const Quadrant& q) {
          return q.level < 1 || (q.contains({3 * towards / 2, towards, 30}) && q.level < 6);
        },
        6);
    forest.partition();
    expect_ghosts(brick, forest);
    forest.refine([](const Quadrant& q) { return q.level < 3; }, 3);
    expect_ghosts(brick, forest);  // as it is: the leaves of a rank may be few
    forest.partition();
    expect_ghosts(brick, forest);
  }
}

TEST(LeafGraph, NamesTheFinerLeavesAcrossTheNearerHalvesOfSides) {
  Forest forest(test::world(), brick);
  forest.refine([](const Quadrant& q) { return q.level < 2 || ((q.x ^ q.y) >> 28 & 1) != 0; }, 3);
  forest.partition();
  const LeafGraph graph(test::world(), brick, forest);
  std::int64_t finer = 0;
  for (const LeafId leaf : graph.local()) {
    const Quadrant& q = graph.leaf(leaf);
    const std::int64_t inner = q.size() / 2 - 1;
    const auto& around = graph.around(leaf);
    finer += graph.has_hanging(leaf, Side::bottom) ? 1 : 0;
    EXPECT_EQ(around.south_half,
              graph.has_hanging(leaf, Side::bottom) ? graph.leaf_at(q.x + inner, q.y - 1) : LeafGraph::none);
    EXPECT_EQ(around.west_half,
              graph.has_hanging(leaf, Side::left) ? graph.leaf_at(q.x - 1, q.y + inner) : LeafGraph::none);
  }
  EXPECT_GT(test::world().sum(finer), 0);
}

TEST(GhostLeaves, OfOneLeafEach) {
  const TreeGrid square({{0, 0}, {1, 1}}, 1, 1);
  Forest forest(test::world(), square);
  forest.refine([](const Quadrant& q) { return q.level < 1; }, 1);
  forest.partition();
  expect_ghosts(square, forest);
}

}  // namespace
}  // namespace quadloop
