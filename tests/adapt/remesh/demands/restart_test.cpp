// A tree read from its record gives itself again; marks change it by a level, and the same marks take back
// what they made.
#include "adapt/remesh/demands/restart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "generate/leaf_quadrant.hpp"
#include "mesher/base/error.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

Geometry disc_in_square() {
  std::vector<Point> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  for (int i = 0; i < 48; ++i) {
    const double angle = -2 * std::numbers::pi * i / 48;
    points.push_back({0.3 + 0.2 * std::cos(angle), -0.1 + 0.2 * std::sin(angle)});
    boundary.push_back(BoundaryId{1});
  }
  return {{{"frame", 0, 30, "none"}, {"disc", 0.03, 30, "wall"}}, points, {0, 4, 52}, boundary};
}

MeshInput disc_input() {
  MeshInput input{disc_in_square(), {}, {}, 0};
  input.mesh.size.min = 0.02;
  input.mesh.size.max = 0.25;
  input.smooth.sweeps = 0;
  return input;
}

TreeRecord tree_of(const MeshInput& input, const std::vector<SplitDemand>& demands,
                   const Communicator& comm = world()) {
  return build_mesh(comm, input.geometry, input.mesh, DemandedSplits(comm, demands)).tree;
}

/// All ranks' leaves, bit for bit.
std::vector<std::array<std::int64_t, 6>> all_leaves(const TreeRecord& tree,
                                                    const Communicator& comm = world()) {
  std::vector<std::array<std::int64_t, 6>> own;
  for (const LeafRecord& leaf : tree.leaves) {
    const Quadrant q = quadrant_of(leaf);
    own.push_back({q.x, q.y, q.level, leaf.wanted, leaf.adapted, leaf.triangles + 1000 * leaf.quads});
  }
  return comm.all_gather_values(std::span<const std::array<std::int64_t, 6>>(own));
}

/// By place alone, so the same on any number of ranks: about one leaf in seven.
bool chosen(const Quadrant& q) {
  return (static_cast<std::uint64_t>(q.x * 31 + q.y * 17 + q.level) * 0x9e3779b97f4a7c15ULL >> 32) % 7 == 0;
}

constexpr int finest = 12;

/// The same for all leaves.
std::vector<std::int8_t> levels_of(const TreeRecord& tree, int level) {
  return std::vector<std::int8_t>(tree.leaves.size(), static_cast<std::int8_t>(level));
}

ChangedSplits refined_by_choice(const TreeRecord& tree, const Communicator& comm = world()) {
  std::vector<RefinementFlag> flags;
  for (const LeafRecord& leaf : tree.leaves)
    flags.push_back(chosen(quadrant_of(leaf)) ? RefinementFlag::refine : RefinementFlag::keep);
  return changed_splits(comm, tree, flags, levels_of(tree, finest));
}

class RestartUnderGradation : public testing::TestWithParam<double> {};

/// Each rank alone makes the tree that all make together, also where demands of one rank's leaves reach into
/// those of another: by gradation from leaf to leaf, and twice, so that the second demands stand on what the
/// first led to.
TEST_P(RestartUnderGradation, OneRankAndAllRanksMakeTheSameTree) {
  MeshInput input = disc_input();
  input.mesh.size.gradation = GetParam();
  const Communicator alone(MPI_COMM_SELF);
  TreeRecord together = tree_of(input, {}), single = tree_of(input, {}, alone);
  ASSERT_EQ(all_leaves(together), all_leaves(single, alone));
  for (int cycle = 0; cycle < 3; ++cycle) {
    const ChangedSplits by_all = refined_by_choice(together), by_one = refined_by_choice(single, alone);
    EXPECT_EQ(by_all.refined, by_one.refined);
    together = tree_of(input, by_all.demands);
    single = tree_of(input, by_one.demands, alone);
    ASSERT_EQ(all_leaves(together), all_leaves(single, alone)) << "refined " << cycle + 1 << " times";
  }
  for (int cycle = 0; cycle < 2; ++cycle) {
    const std::vector<RefinementFlag> of_all(together.leaves.size(), RefinementFlag::coarsen),
        of_one(single.leaves.size(), RefinementFlag::coarsen);
    const ChangedSplits by_all = changed_splits(world(), together, of_all, levels_of(together, finest)),
                        by_one = changed_splits(alone, single, of_one, levels_of(single, finest));
    EXPECT_EQ(by_all.coarsened, by_one.coarsened);
    EXPECT_GT(by_all.coarsened, 0);
    together = tree_of(input, by_all.demands);
    single = tree_of(input, by_one.demands, alone);
    ASSERT_EQ(all_leaves(together), all_leaves(single, alone)) << "coarsened " << cycle + 1 << " times";
  }
}

INSTANTIATE_TEST_SUITE_P(Gradations, RestartUnderGradation, testing::Values(1.25, 1.5, 2.0));

TEST(Restart, WithoutMarksTheTreeIsTheSame) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  EXPECT_EQ(all_leaves(tree_of(input, unchanged_splits(first, input))), all_leaves(first));
  const TreeRecord second = tree_of(input, refined_by_choice(first).demands);
  EXPECT_EQ(all_leaves(tree_of(input, unchanged_splits(second, input))), all_leaves(second));
}

TEST(Restart, EveryMarkedLeafIsSplit) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  const ChangedSplits changed = refined_by_choice(first);
  const auto before = all_leaves(first), after = all_leaves(tree_of(input, changed.demands));
  EXPECT_GT(changed.refined, 20);
  for (const auto& leaf : before) {
    const bool has_cells = leaf[5] > 0;  // what is outside may stay as it is
    if (!has_cells || !chosen({leaf[0], leaf[1], static_cast<int>(leaf[2])})) continue;
    for (const auto& now : after) EXPECT_FALSE(now[0] == leaf[0] && now[1] == leaf[1] && now[2] <= leaf[2]);
  }
}

TEST(Restart, RefiningThenCoarseningByTheSameMarksGivesTheTreeBack) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  const TreeRecord second = tree_of(input, refined_by_choice(first).demands);
  // The leaves in a quadrant that was marked go; its children may have been split further by gradation, then
  // it takes a cycle for each level.
  std::vector<RefinementFlag> flags(second.leaves.size(), RefinementFlag::coarsen);
  TreeRecord third =
      tree_of(input, changed_splits(world(), second, flags, levels_of(second, finest)).demands);
  for (int cycle = 0; cycle < 4; ++cycle) {
    flags.assign(third.leaves.size(), RefinementFlag::coarsen);
    third = tree_of(input, changed_splits(world(), third, flags, levels_of(third, finest)).demands);
  }
  EXPECT_EQ(all_leaves(third), all_leaves(first));
}

/// As a sensor leaves them: no mark where there are no cells.
std::vector<RefinementFlag> flags_of_cells(const TreeRecord& tree, RefinementFlag mark,
                                           const std::function<bool(const Quadrant&)>& where) {
  std::vector<RefinementFlag> flags;
  for (const LeafRecord& leaf : tree.leaves)
    flags.push_back(leaf.triangles + leaf.quads > 0 && where(quadrant_of(leaf)) ? mark
                                                                                : RefinementFlag::keep);
  return flags;
}

TEST(Restart, LeavesAtWallsGoBackThoughTheirSiblingsHaveNoCells) {
  const MeshInput input = disc_input();
  const auto everywhere = [](const Quadrant&) { return true; };
  const TreeRecord first = tree_of(input, {});
  TreeRecord tree = first;
  for (int cycle = 0; cycle < 2; ++cycle) {
    const auto flags = flags_of_cells(tree, RefinementFlag::refine,
                                      [](const Quadrant& q) { return q.level >= 6; });  // those at the disc
    tree = tree_of(input, changed_splits(world(), tree, flags, levels_of(tree, finest)).demands);
  }
  EXPECT_GT(world().sum(std::ssize(tree.leaves)), 2 * world().sum(std::ssize(first.leaves)));
  const std::vector<RefinementFlag> nothing(tree.leaves.size(), RefinementFlag::keep);
  EXPECT_EQ(
      all_leaves(tree_of(input, changed_splits(world(), tree, nothing, levels_of(tree, finest)).demands)),
      all_leaves(tree));
  for (int cycle = 0; cycle < 4; ++cycle) {
    tree = tree_of(input,
                   changed_splits(world(), tree, flags_of_cells(tree, RefinementFlag::coarsen, everywhere),
                                  levels_of(tree, finest))
                       .demands);
  }
  EXPECT_EQ(all_leaves(tree), all_leaves(first));
}

/// One cycle of a mark on every leaf.
TreeRecord all_marked(const MeshInput& input, const TreeRecord& tree, RefinementFlag mark) {
  const ChangedSplits changed = changed_splits(
      world(), tree, std::vector<RefinementFlag>(tree.leaves.size(), mark), levels_of(tree, finest));
  const std::int64_t leaves = world().sum(std::ssize(tree.leaves));
  EXPECT_EQ(mark == RefinementFlag::refine ? changed.refined : changed.coarsened, leaves);
  return tree_of(input, changed.demands);
}

/// Where a quadrant was split twice over, one cycle of marks takes back the last of the two splits, and no
/// more. The case's own leaves are all of one size, so that gradation asks for nothing, and all in the
/// domain.
TEST(Restart, CoarseningGoesBackALevelEachCycle) {
  const std::vector<Point> corners{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  MeshInput input{{{{"frame", 0, 30, "none"}}, corners, {0, 4}, std::vector(4, BoundaryId{0})}, {}, {}, 0};
  input.mesh.size.min = input.mesh.size.max = 0.125;
  input.mesh.size.root = RootOptions{{-1, -1}, 2};
  input.smooth.sweeps = 0;
  const TreeRecord first = tree_of(input, {}), second = all_marked(input, first, RefinementFlag::refine),
                   third = all_marked(input, second, RefinementFlag::refine);
  const auto leaves = all_leaves(first).size();
  EXPECT_EQ(all_leaves(second).size(), 4 * leaves);
  EXPECT_EQ(all_leaves(third).size(), 16 * leaves);
  const TreeRecord fourth = all_marked(input, third, RefinementFlag::coarsen);
  EXPECT_EQ(all_leaves(fourth), all_leaves(second));
  EXPECT_EQ(all_leaves(all_marked(input, fourth, RefinementFlag::coarsen)), all_leaves(first));
}

TEST(Restart, CoarseningNeverPassesTheCasesOwnTree) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  const std::vector<RefinementFlag> flags(first.leaves.size(), RefinementFlag::coarsen);
  const ChangedSplits changed = changed_splits(world(), first, flags, levels_of(first, finest));
  EXPECT_EQ(changed.coarsened, 0);
  EXPECT_EQ(all_leaves(tree_of(input, changed.demands)), all_leaves(first));
}

TEST(Restart, LeavesOfTheFinestLevelAreNotSplit) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  const std::vector<RefinementFlag> flags(first.leaves.size(), RefinementFlag::refine);
  EXPECT_EQ(changed_splits(world(), first, flags, levels_of(first, 1)).refined, 0);
}

TEST(Restart, WantedLevelsStandUnderACoarserCase) {
  const MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  MeshInput coarser = input;
  coarser.mesh.size.min = 0.1;
  coarser.digest = 1;
  const auto before = all_leaves(first),
             after = all_leaves(tree_of(coarser, unchanged_splits(first, coarser)));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ((std::array{before[i][0], before[i][1], before[i][2]}),
              (std::array{after[i][0], after[i][1], after[i][2]}));
}

TEST(Restart, TheRootStaysAndAGeometryOutsideIsRefused) {
  MeshInput input = disc_input();
  const TreeRecord first = tree_of(input, {});
  keep_root(first.attributes, input);
  EXPECT_FALSE(input.mesh.size.root.has_value()) << "the same root anyhow";
  TreeAttributes larger = first.attributes, elsewhere = first.attributes;
  larger.tree_edge *= 2;
  keep_root(larger, input);
  ASSERT_TRUE(input.mesh.size.root.has_value());
  EXPECT_EQ(input.mesh.size.root->tree_edge, larger.tree_edge);
  const Point end = root_box(larger).high, beyond{std::nextafter(end.x, 100), std::nextafter(end.y, 0)};
  EXPECT_EQ(input.mesh.size.root->far_corner, end);
  larger.root_far = beyond;
  keep_root(larger, input);
  EXPECT_EQ(choose_root(input.geometry, input.mesh.size).box().high, beyond) << "to the bit";
  elsewhere.root_x += 0.5;
  EXPECT_THROW(keep_root(elsewhere, input), InputError);
}

}  // namespace
}  // namespace quadloop::adapt
