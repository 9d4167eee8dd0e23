// Nodes that demands lead to, counted before the mesh is made, beside what is allowed.
#include "adapt/remesh/demands/trial_count.hpp"

#include <gtest/gtest.h>

#include "adapt/remesh/remesh.hpp"
#include "tests/adapt/remesh/square_input.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

TEST(TrialCount, IsThatOfTheMesh) {
  const MeshInput input = test::square_of_one_tree(0.125);
  const TrialCount count(world(), input, {});
  EXPECT_EQ(count.nodes_after({}).least, 81);
  EXPECT_EQ(count.nodes_after({}).most, 81);
  ChangedSplits all;  // every leaf once more
  if (world().is_root()) {
    for (std::int64_t k = 0; k < 64; ++k) {
      const std::int64_t edge = std::int64_t{1} << (Quadrant::unit_level - 3);
      all.demands.push_back({{k % 8 * edge, k / 8 * edge, 3}, 1U << 3});
    }
  }
  EXPECT_EQ(count.nodes_after(all).most, 17 * 17);
  EXPECT_DOUBLE_EQ(count.filled(162, {}).most, 0.5);
  EXPECT_DOUBLE_EQ(count.filled(162, {}).least, 0.5);
  EXPECT_EQ(count.filled({}, {}).most, 0) << "no cap and no limit";
}

TEST(TrialCount, KeepsToWhatIsAllowed) {
  MeshInput input = test::square_of_one_tree(0.125);
  input.mesh.limit.cells = 8;
  const TrialCount count(world(), input, {});
  EXPECT_FALSE(count.allowed({}));
  EXPECT_GT(count.share_of_limit({}), 4);
  EXPECT_EQ(count.nodes_after({}).most, TrialCount::beyond);
  EXPECT_GT(count.filled(1000, {}).least, 4);
}

}  // namespace
}  // namespace quadloop::adapt
