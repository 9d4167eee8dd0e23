// How many leaves there will be: few are counted, many are estimated.
#include "mesher/sizes/leaf_estimate.hpp"

#include <gtest/gtest.h>

#include "mesher/sizes/size_cursor.hpp"
#include "tests/sizes/forest_of.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::LargeDiamondSizes;

/// All of them, one by one.
LeafEstimate counted(const LargeDiamondSizes& sizes) {
  SizeTree tree = sizes.tree();
  SizeCursor cursor(tree);
  LeafEstimate all;
  for (const Quadrant& q : test::forest_of(sizes)) {
    if (!cursor.segments_in(q).empty())
      ++all.cut;
    else
      ++(sizes.inside.contains(sizes.grid.box_of(q).centre()) ? all.inside : all.outside);
  }
  return all;
}

TEST(LeafEstimate, OfFewLeavesIsTheirNumberInTheDomain) {
  const LargeDiamondSizes sizes(0.06);
  SizeTree tree = sizes.tree();
  const LeafEstimate estimate = estimate_leaves(tree), expected = counted(sizes);
  EXPECT_EQ(estimate.cut, expected.cut);
  EXPECT_EQ(estimate.inside, expected.inside);
  EXPECT_NEAR(estimate.outside / expected.outside, 1, 0.4);
  EXPECT_GT(estimate.all(), 200);
}

TEST(LeafEstimate, IsTheSameEachTimeWhateverTheTreeWasAsked) {
  const LargeDiamondSizes sizes(0.0015);
  SizeTree tree = sizes.tree();
  const double first = estimate_leaves(tree).all();
  EXPECT_EQ(estimate_leaves(tree).all(), first) << "the tree has grown since";
}

TEST(LeafEstimate, IsTheSameToTheLastBitWhereRanksShareIt) {
  for (const double spacing : {0.06, 0.0015}) {
    const LargeDiamondSizes sizes(spacing);
    SizeTree own_tree = sizes.tree(), shared_tree = sizes.tree();
    const LeafEstimate own = estimate_leaves(own_tree), shared = estimate_leaves(test::world(), shared_tree);
    EXPECT_EQ(shared.cut, own.cut);
    EXPECT_EQ(shared.inside, own.inside);
    EXPECT_EQ(shared.outside, own.outside);
    for (const Corner quarter : corners_along_curve) {
      const Quadrant q = Quadrant{0, 0, 0}.child(quarter);
      EXPECT_EQ(shared.sample.leaves_in(q), own.sample.leaves_in(q));
    }
  }
}

TEST(LeafEstimate, OfEachKindIsNearItsNumberAtEverySpacing) {
  for (const double spacing : {0.004, 0.002, 0.001}) {
    const LargeDiamondSizes sizes(spacing);
    SizeTree tree = sizes.tree();
    const LeafEstimate estimate = estimate_leaves(tree), expected = counted(sizes);
    EXPECT_NEAR(estimate.cut / expected.cut, 1, 0.2);
    EXPECT_NEAR(estimate.inside / expected.inside, 1, 0.2);
    EXPECT_NEAR(estimate.outside / expected.outside, 1, 0.4);
  }
}

}  // namespace
}  // namespace quadloop
