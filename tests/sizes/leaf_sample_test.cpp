// How many leaves a quadrant will have, by a sample of them.
#include "mesher/sizes/leaf_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/sizes/leaf_estimate.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "tests/sizes/forest_of.hpp"

namespace quadloop {
namespace {

using test::LargeDiamondSizes;

double counted(const Quadrant& q, const std::vector<Quadrant>& leaves) {
  return static_cast<double>(std::ranges::count_if(leaves, [&](const Quadrant& r) { return q.contains(r); }));
}

/// Quadrants of a level, in all of the root.
std::vector<Quadrant> quadrants_of(int level) {
  std::vector<Quadrant> some{{}};
  for (int l = 0; l < level; ++l) {
    std::vector<Quadrant> finer;
    for (const Quadrant& q : some) {
      for (const Corner quarter : corners_along_curve) finer.push_back(q.child(quarter));
    }
    some = std::move(finer);
  }
  return some;
}

TEST(LeafSample, WithoutRowsKnowsOfNoLeaf) {
  EXPECT_EQ(LeafSample().leaves(), 0);
  EXPECT_EQ(LeafSample().leaves_in({}), 0);
}

TEST(LeafSample, CountsBelowAQuadrantAndAtIt) {
  const Quadrant root, right = Quadrant{}.child(Corner::south_east), deep = right.child(Corner::north_west);
  const std::int64_t tree = std::int64_t{1} << Quadrant::unit_level;
  const LeafSample sample({{{tree, 0, 0}, 32},
                           {deep, 2},
                           {root.child(Corner::north_east), 16},
                           {right.child(Corner::south_west), 1},
                           {root.child(Corner::south_west), 8}});
  EXPECT_EQ(sample.leaves(), 59);
  EXPECT_EQ(sample.leaves_in(root), 27) << "of its own tree";
  EXPECT_EQ(sample.leaves_in(right), 3);
  EXPECT_EQ(sample.leaves_in(deep), 2);
  EXPECT_EQ(sample.leaves_in(root.child(Corner::north_west)), 0);
  EXPECT_EQ(sample.leaves_in({tree, 0, 0}), 32);
}

TEST(LeafSample, OfFewLeavesIsTheirNumberWhereAllIsInside) {
  const LargeDiamondSizes sizes(0.06);
  SizeTree tree = sizes.tree();
  const LeafSample sample = estimate_leaves(tree).sample;
  const std::vector<Quadrant> leaves = test::forest_of(sizes);
  SizeCursor cursor(tree);
  int inside = 0;
  for (const Quadrant& q : quadrants_of(3)) {
    if (!cursor.segments_in(q).empty() || !sizes.inside.contains(sizes.grid.box_of(q).centre())) continue;
    EXPECT_EQ(sample.leaves_in(q), counted(q, leaves));
    ++inside;
  }
  EXPECT_GT(inside, 5);
  EXPECT_EQ(sample.leaves(), estimate_leaves(tree).all());
}

TEST(LeafSample, OfManyTellsHalvesAboutRight) {
  const LargeDiamondSizes sizes(0.001);
  SizeTree tree = sizes.tree();
  const LeafSample sample = estimate_leaves(tree).sample;
  const std::vector<Quadrant> leaves = test::forest_of(sizes);
  for (const Quadrant& q : quadrants_of(1))
    EXPECT_NEAR(sample.leaves_in(q) / counted(q, leaves), 1, 0.3) << q.x << " " << q.y;
}

}  // namespace
}  // namespace quadloop
