// How many leaves there will be: few are counted, many are estimated.
#include "mesher/sizes/leaf_estimate.hpp"

#include <gtest/gtest.h>

#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {
namespace {

/// A square of edge 2 with a diamond of void.
Geometry diamond_in_square(double spacing) {
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  boundary.resize(8, BoundaryId{1});
  return {{{"frame", 0.5, 30, "none"}, {"diamond", spacing, 30, "wall"}},
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0.6, 0.23}, {0.23, 0.6}, {0.6, 0.97}, {0.97, 0.6}},
          {0, 4, 8},
          boundary};
}

struct Sizes {
  explicit Sizes(double spacing) : geometry{diamond_in_square(spacing)} {
    options.min = spacing;
    options.max = 0.5;
  }
  Geometry geometry;
  ShiftedOutline outline{geometry};
  Interior inside{outline};
  Lattice lattice{Box{{-1.5, -1.5}, {1.5, 1.5}}, 1, 1};
  DemandedSplits demanded;
  SizeOptions options;
  SizeTree tree() const {
    return {outline, lattice, options, [](const Quadrant&, std::span<const std::int32_t>) { return false; },
            demanded};
  }
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
