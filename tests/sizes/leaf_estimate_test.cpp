// How many leaves there will be: few are counted, many are estimated.
#include "mesher/sizes/leaf_estimate.hpp"

#include <gtest/gtest.h>

#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "tests/sizes/diamond_sizes.hpp"

namespace quadloop {
namespace {

struct Sizes : test::DiamondSizes {
  explicit Sizes(double spacing) : DiamondSizes({{0.6, 0.6}, 0.37}, spacing, spacing, 0.5) {}
};

/// All of them, one by one.
void count_below(const Quadrant& q, Gradation& gradation, SizeCursor& cursor, const Sizes& sizes,
                 LeafEstimate& counted) {
  if (q.level == 0 || gradation.must_split(q)) {
    for (const Corner quarter : corners_along_curve)
      count_below(q.child(quarter), gradation, cursor, sizes, counted);
    return;
  }
  if (!cursor.segments_in(q).empty())
    ++counted.cut;
  else
    ++(sizes.inside.contains(sizes.lattice.box_of(q).centre()) ? counted.inside : counted.outside);
}

LeafEstimate counted(const Sizes& sizes) {
  const SizeTree tree = sizes.tree();
  Gradation gradation(tree);
  SizeCursor cursor(tree);
  LeafEstimate all;
  count_below({}, gradation, cursor, sizes, all);
  return all;
}

TEST(LeafEstimate, OfFewLeavesIsTheirNumber) {
  const Sizes sizes(0.06);
  const LeafEstimate estimate = estimate_leaves(sizes.tree(), sizes.inside), expected = counted(sizes);
  EXPECT_EQ(estimate.cut, expected.cut);
  EXPECT_EQ(estimate.inside, expected.inside);
  EXPECT_EQ(estimate.outside, expected.outside);
  EXPECT_GT(estimate.all(), 200);
}

TEST(LeafEstimate, IsTheSameEachTimeWhateverTheTreeWasAsked) {
  const Sizes sizes(0.0015);
  const SizeTree tree = sizes.tree();
  const double first = estimate_leaves(tree, sizes.inside).all();
  EXPECT_EQ(estimate_leaves(tree, sizes.inside).all(), first) << "the tree has grown since";
}

TEST(LeafEstimate, OfEachKindIsNearItsNumberAtEverySpacing) {
  for (const double spacing : {0.004, 0.002, 0.001}) {
    const Sizes sizes(spacing);
    const LeafEstimate estimate = estimate_leaves(sizes.tree(), sizes.inside), expected = counted(sizes);
    EXPECT_NEAR(estimate.cut / expected.cut, 1, 0.2);
    EXPECT_NEAR(estimate.inside / expected.inside, 1, 0.2);
    EXPECT_NEAR(estimate.outside / expected.outside, 1, 0.2);
  }
}

}  // namespace
}  // namespace quadloop
