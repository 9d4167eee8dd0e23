// Sizes that follow from the leaves requested by adaptation.
#include "mesher/sizes/demanded_sizes.hpp"

#include <gtest/gtest.h>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// Splits of the unit square, of its lower left quarter and of that one's lower left quarter.
DemandedSplits splits() {
  const std::vector<SplitDemand> demands{{Quadrant{0, 0, 2}, 0b111}};
  return {world(), world().is_root() ? demands : std::vector<SplitDemand>{}};
}

TEST(DemandedSizes, GrowWithTheDistanceFromTheLeaves) {
  const TreeGrid grid({{0, 0}, {1, 1}}, 1, 1);
  const DemandedSplits demanded = splits();
  const DemandedSizes sizes(grid, demanded, 2);
  const auto at = [&](Point p) { return sizes.near(p, p, 10); };
  EXPECT_EQ(at({0.1, 0.2}), 0.125);
  EXPECT_DOUBLE_EQ(at({0.3, 0.1}), 0.125 + 0.5 * 0.05);
  EXPECT_EQ(at({0.49, 0.1}), std::min(0.25, 0.125 + 0.5 * 0.24));
  EXPECT_EQ(at({0.9, 0.9}), 0.5) << "a sibling of the divided quarter";
  EXPECT_DOUBLE_EQ(at({0.1, -2}), 0.125 + 0.5 * 2);
  EXPECT_EQ(sizes.near({0.1, 0.2}, {0.1, 0.2}, 0.1), 0.1) << "at most";
}

TEST(DemandedSizes, AreTheSmallestAlongASegment) {
  const TreeGrid grid({{0, 0}, {1, 1}}, 1, 1);
  const DemandedSplits demanded = splits();
  const DemandedSizes sizes(grid, demanded, 1.5);
  const Point left{-1, 0.1}, right{2, 0.1}, above{0.9, 1.3}, aside{1.7, 0.2};
  EXPECT_EQ(sizes.near(left, right, 10), 0.125) << "through the leaves";
  EXPECT_EQ(sizes.near({-1, 1}, {1, -1}, 10), 0.125) << "through their corner";
  EXPECT_EQ(sizes.near(above, aside, 10), sizes.near(aside, above, 10));
  double least = 10;
  for (int k = 0; k <= 1000; ++k) {
    const Point p = above + (k / 1000.0) * (aside - above);
    least = std::min(least, sizes.near(p, p, 10));
  }
  EXPECT_NEAR(sizes.near(above, aside, 10), least, 1e-3);
  EXPECT_LE(sizes.near(above, aside, 10), least);
}

TEST(DemandedSizes, WithoutRequestsHaveNoLimit) {
  const TreeGrid grid({{0, 0}, {1, 1}}, 1, 1);
  const DemandedSplits none;
  EXPECT_EQ(DemandedSizes(grid, none, 2).near({0, 0}, {1, 1}, 7), 7);
}

}  // namespace
}  // namespace quadloop
