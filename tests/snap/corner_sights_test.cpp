// Edges of leaves, what grid vertices see along them, and which leaves see a snap.
#include "mesher/snap/corner_sights.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/snap/leaf_edge.hpp"
#include "mesher/snap/snap.hpp"
#include "tests/snap/traced_leaves.hpp"

namespace quadloop {
namespace {

using test::TracedLeaves;

/// The domain above a height, in leaves of edge 1.
Geometry above(double y = 1.125) { return test::loops_of({{{-1, y}, {5, y}, {5, 9}, {-1, 9}}}); }

GridPoint at(std::int64_t x, std::int64_t y) { return {x * TracedLeaves::unit, y * TracedLeaves::unit}; }

std::vector<Sight> seen_from(const std::vector<Sight>& sights, GridPoint corner) {
  std::vector<Sight> own;
  std::copy_if(sights.begin(), sights.end(), std::back_inserter(own),
               [&](const Sight& s) { return s.corner == corner; });
  return own;
}

TEST(CornerSights, TheNearerEndOfAnEdgeSeesItsCrossingThroughBothLeaves) {
  const TracedLeaves leaves(above());
  const auto sights = sights_by_corner(leaves.graph, leaves.grid, leaves.geometry, leaves.traced);
  EXPECT_TRUE(std::is_sorted(sights.begin(), sights.end(), [](const Sight& a, const Sight& b) {
    return comes_earlier(a.corner, b.corner);
  }));
  for (std::int64_t x = 0; x <= 4; ++x) {
    if (!leaves.at_local_leaf(at(x, 1))) continue;
    const auto below = seen_from(sights, at(x, 1));
    EXPECT_EQ(below.size(), x == 0 || x == 4 ? 1U : 2U);
    for (const Sight& s : below) {
      EXPECT_EQ(s.direction, Direction::north);
      EXPECT_EQ(s.distance, 0.125);
      EXPECT_EQ(s.edge, 1);
      EXPECT_EQ(s.segment, 0);
    }
  }
  for (std::int64_t x = 0; x <= 4; ++x) {
    EXPECT_TRUE(seen_from(sights, at(x, 2)).empty());
    EXPECT_TRUE(seen_from(sights, at(x, 3)).empty());
  }
}

TEST(CornerSights, BothEndsOfAnEdgeSeeACrossingInItsMiddle) {
  const TracedLeaves leaves(above(1.5));
  const auto sights = sights_by_corner(leaves.graph, leaves.grid, leaves.geometry, leaves.traced);
  int corners = 0;
  for (std::int64_t x = 0; x <= 4; ++x) {
    for (const std::int64_t y : {1, 2}) {
      if (!leaves.at_local_leaf(at(x, y))) continue;
      ++corners;
      const auto own = seen_from(sights, at(x, y));
      EXPECT_FALSE(own.empty());
      for (const Sight& s : own) {
        EXPECT_EQ(s.direction, y == 1 ? Direction::north : Direction::south);
        EXPECT_EQ(s.distance, 0.5);
      }
    }
  }
  EXPECT_GE(test::world().sum(corners), 10);
}

TEST(CornerSights, OneOfTheTwoLeavesSeesAnEntryTheOtherAnExit) {
  const TracedLeaves leaves(above());
  const auto sights = sights_by_corner(leaves.graph, leaves.grid, leaves.geometry, leaves.traced);
  int corners = 0;
  for (std::int64_t x = 1; x <= 3; ++x) {
    if (!leaves.at_local_leaf(at(x, 1))) continue;
    const auto own = seen_from(sights, at(x, 1));
    EXPECT_EQ(own.size(), 2U);
    if (own.size() == 2) {
      EXPECT_NE(own[0].at_entry, own[1].at_entry);
    }
    ++corners;
  }
  EXPECT_GE(test::world().sum(corners), 3);
}

TEST(LeafEdge, ASideWithAHangingNodeIsTwoEdges) {
  const TracedLeaves leaves(above(), {{0, 0}, {2, 4}});  // finer on the left
  for (const LeafId leaf : leaves.graph.local()) {
    const Quadrant& q = leaves.graph.leaf(leaf);
    for (const Side side : all_sides) {
      const Box box = leaves.grid.box_of(q);
      const bool hangs = leaves.graph.has_hanging(leaf, side);
      for (const double share : {0.25, 0.75}) {
        const Point p = box.low + Point{share * box.width(), share * box.height()};
        const LeafEdge edge = leaf_edge_near(leaves.graph, leaves.grid, leaf, side, p);
        EXPECT_EQ(edge.line, q.line(side));
        EXPECT_EQ(edge.to - edge.from, hangs ? q.size() / 2 : q.size());
        EXPECT_LE(edge.at(leaves.grid, edge.from), edge.along(p));
        EXPECT_GE(edge.at(leaves.grid, edge.to), edge.along(p));
        EXPECT_EQ(edge.length(leaves.grid), hangs ? 1 : leaves.grid.edge(q.level));
        EXPECT_EQ(edge.vertical() ? edge.point(edge.from).x : edge.point(edge.from).y, edge.line);
      }
    }
  }
}

TEST(LeafEdge, TheSmallestLeafAtACornerCounts) {
  const TracedLeaves leaves(above(), {{0, 0}, {2, 4}});
  LeafFinder finder(leaves.graph);
  const auto shortest = [&](std::int64_t x, std::int64_t y) {
    return shortest_edge_of(leaves.graph, leaves.grid, finder.leaves_round(at(x, y)));
  };
  if (leaves.at_local_leaf(at(2, 2))) {
    EXPECT_EQ(shortest(2, 2), 1);
  }
  if (leaves.at_local_leaf(at(4, 2))) {
    EXPECT_EQ(shortest(4, 2), 2);
  }
}

TEST(SnapsOfLeaves, EachLeafRoundACornerSeesItFromItsOwnSide) {
  const TracedLeaves leaves(above());
  Snap snap;
  snap.corner = at(2, 1);
  std::vector<Snap> snaps{snap};
  find_leaves_round(leaves.graph, snaps);
  for (const LeafSnap& seen : snaps_of_leaves(leaves.graph, snaps)) {
    EXPECT_TRUE(leaves.graph.is_local(seen.leaf));
    EXPECT_EQ(leaves.graph.leaf(seen.leaf).at(seen.site), snap.corner);
    EXPECT_EQ(seen.snap, snaps.data());
  }
  EXPECT_EQ(test::world().sum(std::ssize(snaps_of_leaves(leaves.graph, snaps))), 4);
}

TEST(SnapsOfLeaves, AHangingNodeIsSeenOnceByTheCoarseLeaf) {
  const TracedLeaves leaves(above(), {{0, 0}, {2, 4}});
  Snap snap;
  snap.corner = at(2, 1);  // in the middle of the left side of the coarse leaf at (2, 0)
  std::vector<Snap> snaps{snap};
  find_leaves_round(leaves.graph, snaps);
  std::vector<Site> own;
  for (const LeafSnap& seen : snaps_of_leaves(leaves.graph, snaps)) own.push_back(seen.site);
  auto all = test::world().all_gather_values(std::span<const Site>(own));
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector{Site::south_east, Site::north_east, Site::left_middle}));
}

TEST(SnapsOfLeaves, ABentEdgeIsSeenFromItsTwoSides) {
  const TracedLeaves leaves(above());
  Snap snap;
  snap.corner = {at(2, 1).x, at(2, 1).y + TracedLeaves::unit / 2};
  snap.on_edge = snap.vertical = true;
  std::vector<Snap> snaps{snap};
  find_leaves_round(leaves.graph, snaps);
  std::vector<Site> own;
  for (const LeafSnap& seen : snaps_of_leaves(leaves.graph, snaps)) own.push_back(seen.site);
  auto all = test::world().all_gather_values(std::span<const Site>(own));
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector{Site::on_right, Site::on_left}));
}

TEST(SnapsOfLeaves, AreSortedByLeafAndNoneAtAllIsWell) {
  const TracedLeaves leaves(above());
  EXPECT_TRUE(snaps_of_leaves(leaves.graph, {}).empty());
  std::vector<Snap> snaps(3);
  snaps[0].corner = at(3, 3);
  snaps[1].corner = at(1, 1);
  snaps[2].corner = at(0, 0);
  find_leaves_round(leaves.graph, snaps);
  const auto seen = snaps_of_leaves(leaves.graph, snaps);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [](const LeafSnap& a, const LeafSnap& b) { return a.leaf < b.leaf; }));
  EXPECT_EQ(test::world().sum(std::ssize(seen)), 9);
}

}  // namespace
}  // namespace quadloop
