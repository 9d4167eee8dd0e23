// Leaves that are each other's mirror images agree, on any number of ranks.
#include "adapt/remesh/demands/mirrored_leaves.hpp"

#include <gtest/gtest.h>

#include "adapt/remesh/demands/restart.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// Two trees above each other, the lower one with four leaves, the upper one whole.
TreeRecord two_trees() {
  constexpr std::int32_t half = std::int32_t{1} << (Quadrant::unit_level - 1);
  TreeRecord tree;
  tree.attributes.trees_x = 1;
  tree.attributes.trees_y = 2;
  const std::vector<LeafRecord> all{
      {0, 0, 0, 0, 1}, {0, 0, half, 0, 1}, {0, 0, 0, half, 1}, {0, 0, half, half, 1}, {0, 1, 0, 0, 0}};
  for (int i = 0; i < 5; ++i) {
    if (i * world().size() / 5 == world().rank()) tree.leaves.push_back(all[i]);
  }
  return tree;
}

std::vector<double> agreed(MirrorAxis axis, OfImages of_images) {
  const TreeRecord tree = two_trees();
  const std::int64_t first = world().exclusive_sum(std::ssize(tree.leaves));
  std::vector<double> values;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i)
    values.push_back(static_cast<double>(first) + static_cast<double>(i) + 1);
  agree_with_images(world(), axis, tree, of_images, values);
  return world().all_gather_values(std::span<const double>(values));
}

TEST(MirroredLeaves, GetTheLargerOrTheSmallerValue) {
  EXPECT_EQ(agreed(MirrorAxis::y, OfImages::larger), (std::vector<double>{2, 2, 4, 4, 5}));
  EXPECT_EQ(agreed(MirrorAxis::y, OfImages::smaller), (std::vector<double>{1, 1, 3, 3, 5}));
}

TEST(MirroredLeaves, WithoutAnImageKeepTheirs) {
  EXPECT_EQ(agreed(MirrorAxis::x, OfImages::larger), (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(MirroredLeaves, DemandsHaveTheirImages) {
  TreeAttributes tree;
  tree.trees_x = 1;
  tree.trees_y = 2;
  constexpr std::int64_t quarter = std::int64_t{1} << (Quadrant::unit_level - 2);
  const std::vector<SplitDemand> both = with_images(MirrorAxis::x, tree, {{{quarter, 0, 2}, 3}});
  ASSERT_EQ(both.size(), 2);
  EXPECT_EQ(both[1].leaf, (Quadrant{quarter, 7 * quarter, 2}));
  EXPECT_EQ(both[1].levels, 3U);
  EXPECT_EQ(image_of(MirrorAxis::y, tree, {quarter, 0, 2}), (Quadrant{2 * quarter, 0, 2}));
}

TEST(MirroredLeaves, WallsAgree) {
  MeasuredWall wall{{{0, 0}, {1, 1}, 10, 20}, {{1, -1}, {0, 0}, 21, 9}, {{5, 5}, {6, 6}, 1, 2}};
  agree_with_images(MirrorAxis::x, wall);
  EXPECT_EQ(wall,
            (MeasuredWall{{{0, 0}, {1, 1}, 10, 21}, {{1, -1}, {0, 0}, 21, 10}, {{5, 5}, {6, 6}, 1, 2}}));
  std::vector<MeasuredThickness> thickness{{{0, 0}, {1, 1}, 10, 20}, {{1, -1}, {0, 0}, 21, 9}};
  agree_with_images(MirrorAxis::x, thickness);
  EXPECT_EQ(thickness, (std::vector<MeasuredThickness>{{{0, 0}, {1, 1}, 10, 21}, {{1, -1}, {0, 0}, 21, 10}}));
}

}  // namespace
}  // namespace quadloop::adapt
