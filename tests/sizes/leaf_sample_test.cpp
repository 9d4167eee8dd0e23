// How many leaves a quadrant will have, by a sample of them.
#include "mesher/sizes/leaf_sample.hpp"

#include <gtest/gtest.h>

#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/leaf_estimate.hpp"
#include "tests/sizes/diamond_sizes.hpp"

namespace quadloop {
namespace {

struct Sizes : test::DiamondSizes {
  explicit Sizes(double spacing) : DiamondSizes({{0.6, 0.6}, 0.37}, spacing, spacing, 0.5) {}
};

/// The leaves below a quadrant, one by one.
double counted(const Quadrant& q, Gradation& gradation) {
  if (q.level > 0 && !gradation.must_split(q)) return 1;
  double leaves = 0;
  for (const Corner quarter : corners_along_curve) leaves += counted(q.child(quarter), gradation);
  return leaves;
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

TEST(LeafSample, OfFewLeavesIsTheirNumberInEachQuadrant) {
  const Sizes sizes(0.06);
  const SizeTree tree = sizes.tree();
  Gradation gradation(tree);
  const LeafSample sample = estimate_leaves(tree, sizes.inside).sample;
  for (const Quadrant& q : quadrants_of(2)) EXPECT_EQ(sample.leaves_in(q), counted(q, gradation));
  EXPECT_EQ(sample.leaves(), estimate_leaves(tree, sizes.inside).all());
}

TEST(LeafSample, OfManyTellsHalvesAboutRight) {
  const Sizes sizes(0.001);
  const SizeTree tree = sizes.tree();
  Gradation gradation(tree);
  const LeafSample sample = estimate_leaves(tree, sizes.inside).sample;
  for (const Quadrant& q : quadrants_of(1))
    EXPECT_NEAR(sample.leaves_in(q) / counted(q, gradation), 1, 0.3) << q.x << " " << q.y;
}

}  // namespace
}  // namespace quadloop
