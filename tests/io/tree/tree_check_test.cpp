// Which records are trees that a mesh can have.
#include "io/tree/tree_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

constexpr std::int32_t edge = std::int32_t{1} << 30;

/// A leaf of the unit tree by its column and row on its level.
LeafRecord leaf(int level, std::int32_t column, std::int32_t row) {
  LeafRecord record;
  record.level = record.wanted = static_cast<std::int8_t>(level);
  record.x = column * (edge >> level);
  record.y = row * (edge >> level);
  record.block = 1;
  record.quads = 1;
  return record;
}

/// Two trees side by side, the first in seven leaves, the second whole; along the curve.
std::vector<LeafRecord> leaves() {
  std::vector<LeafRecord> all{leaf(1, 0, 0), leaf(2, 2, 0), leaf(2, 3, 0), leaf(2, 2, 1),
                              leaf(2, 3, 1), leaf(1, 0, 1), leaf(1, 1, 1)};
  all.push_back(leaf(0, 0, 0));
  all.back().tree_x = 1;
  return all;
}

/// What is said of the leaves, shared out over the ranks.
std::string fault_of(const std::vector<LeafRecord>& all,
                     const std::function<void(TreeAttributes&)>& change = {}) {
  TreeRecord tree;
  tree.attributes.trees_x = 2;
  tree.attributes.tree_edge = 1;
  tree.attributes.quads = 8;
  if (change) change(tree.attributes);
  const std::size_t begin = all.size() * world().rank() / world().size(),
                    end = all.size() * (world().rank() + 1) / world().size();
  tree.leaves.assign(all.begin() + static_cast<std::ptrdiff_t>(begin),
                     all.begin() + static_cast<std::ptrdiff_t>(end));
  try {
    require_whole_tree(world(), tree, begin > 0 ? std::optional(all[begin - 1]) : std::nullopt, "a.tree.h5");
    return {};
  } catch (const InputError& fault) {
    return fault.what();
  }
}

void expect_fault(const std::string& says, const std::function<void(std::vector<LeafRecord>&)>& change) {
  std::vector<LeafRecord> changed = leaves();
  change(changed);
  const std::string fault = fault_of(changed);
  EXPECT_TRUE(fault.starts_with("a.tree.h5: ") && fault.find(says) != std::string::npos)
      << says << ": " << fault;
}

TEST(WholeTree, IsWhole) { EXPECT_EQ(fault_of(leaves()), ""); }

TEST(WholeTree, LeavesFollowEachOtherAlongTheCurve) {
  expect_fault("does not follow", [](auto& all) { all.erase(all.begin() + 2); });
  expect_fault("does not follow", [](auto& all) { std::swap(all[1], all[3]); });
  expect_fault("does not follow", [](auto& all) { all.insert(all.begin() + 5, all[5]); });
  expect_fault("does not follow", [](auto& all) { all.erase(all.begin() + 6); });  // the tree ends early
  expect_fault("does not follow", [](auto& all) { all.erase(all.begin()); });
  expect_fault("have 1 trees, but 2", [](auto& all) { all.pop_back(); });
  expect_fault("have 1 whole trees, but 2", [](auto& all) {
    all.back() = leaf(1, 0, 0);
    all.back().tree_x = 1;
  });
}

TEST(WholeTree, EachLeafIsPossible) {
  expect_fault("is in none of the trees", [](auto& all) { all[7].tree_x = 2; });
  expect_fault("is in none of the trees", [](auto& all) { all[0].tree_y = -1; });
  expect_fault("has an impossible level", [](auto& all) { all[1].level = -1; });
  expect_fault("is not on the grid", [](auto& all) { all[1].x += 1; });
  expect_fault("is coarser than its target level 3", [](auto& all) { all[1].wanted = 3; });
  expect_fault("has splits below itself ('adapted' is 0x4)", [](auto& all) { all[1].adapted = 4; });
  expect_fault("below 0", [](auto& all) { all[1].triangles = -1; });
  expect_fault("is outside the domain, but has cells", [](auto& all) { all[1].block = 0; });
}

TEST(WholeTree, CellsAreAsManyAsAreSaid) {
  EXPECT_NE(fault_of(leaves(), [](TreeAttributes& a) { a.quads = 9; }).find("have 8 quadrilaterals, but 9"),
            std::string::npos);
  EXPECT_NE(fault_of(leaves(), [](TreeAttributes& a) { a.triangles = 1; }).find("have 0 triangles, but 1"),
            std::string::npos);
}

TEST(TreeAttributes, ArePossible) {
  const auto fault = [](const std::function<void(TreeAttributes&)>& change) -> std::string {
    TreeAttributes attributes;
    attributes.tree_edge = 1;
    change(attributes);
    try {
      require_possible_attributes(attributes, 4, "a.tree.h5");
      return {};
    } catch (const InputError& refusal) {
      return refusal.what();
    }
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault([](TreeAttributes&) {}), "");
  EXPECT_EQ(fault([](TreeAttributes& a) { a.gradation = 2, a.trees_x = a.trees_y = 2; }), "");
  EXPECT_NE(fault([&](TreeAttributes& a) { a.root_x = none; }), "");
  EXPECT_NE(fault([&](TreeAttributes& a) { a.tree_edge = none; }), "");
  EXPECT_NE(fault([](TreeAttributes& a) { a.tree_edge = 0; }), "");
  EXPECT_NE(fault([](TreeAttributes& a) { a.gradation = 1; }), "");
  EXPECT_NE(fault([](TreeAttributes& a) { a.gradation = 2.01; }), "");
  EXPECT_NE(fault([](TreeAttributes& a) { a.trees_x = 5; }), "") << "each tree has a leaf";
  EXPECT_NE(
      fault([](TreeAttributes& a) { a.trees_x = a.trees_y = std::numeric_limits<std::int32_t>::max(); }), "");
  EXPECT_NE(fault([](TreeAttributes& a) { a.nodes = -1; }), "");
  EXPECT_EQ(fault([](TreeAttributes& a) { a.root_far = Point{1 + 1e-15, 1 - 1e-15}; }), "");
  EXPECT_NE(fault([](TreeAttributes& a) {
              a.root_far = Point{1, 1.1};
            }).find("its root ends at (1, 1.1)"),
            std::string::npos);
  EXPECT_NE(fault([&](TreeAttributes& a) { a.root_far = Point{1, none}; }), "");
}

/// Its leaves are all on rank 0.
TreeRecord hand_made_tree() {
  TreeRecord tree;
  tree.attributes.trees_x = 2;
  tree.attributes.tree_edge = 0.5;
  tree.attributes.quads = 8;
  if (world().is_root()) tree.leaves = leaves();
  return tree;
}

TEST(TreeFile, AHandMadeTreeComesBackWhole) {
  const test::TemporaryFolder folder;
  TreeRecord tree = hand_made_tree();
  write_tree(world(), tree, folder.file("a.tree.h5"));
  const TreeRecord read = read_tree(world(), folder.file("a.tree.h5"));
  EXPECT_EQ(read.attributes.tree_edge, 0.5);
  EXPECT_FALSE(read.attributes.root_far.has_value());
  const Point far{std::nextafter(1, 2), 0.5};
  tree.attributes.root_far = far;
  write_tree(world(), tree, folder.file("b.tree.h5"));
  EXPECT_EQ(read_tree(world(), folder.file("b.tree.h5")).attributes.root_far, far) << "to the bit";
  EXPECT_EQ(world().sum(std::ssize(read.leaves)), 8) << "though most ranks wrote none";
  const std::int64_t first = world().exclusive_sum(std::ssize(read.leaves));
  for (std::size_t i = 0; i < read.leaves.size(); ++i) {
    const LeafRecord expected = leaves()[static_cast<std::size_t>(first) + i];
    EXPECT_EQ(read.leaves[i].x, expected.x);
    EXPECT_EQ(read.leaves[i].level, expected.level);
    EXPECT_EQ(read.leaves[i].tree_x, expected.tree_x);
  }
}

TEST(TreeFile, BlocksOfTheCellsComeBackOnEveryRank) {
  const test::TemporaryFolder folder;
  TreeRecord tree = hand_made_tree();
  tree.block_runs = {{4, 0, 3}, {4, 1, 4}, {4, 0, 1}};
  write_tree(world(), tree, folder.file("a.tree.h5"));
  const std::vector<BlockRun> read = read_tree(world(), folder.file("a.tree.h5")).block_runs;
  ASSERT_EQ(read.size(), 3);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].corners, tree.block_runs[i].corners);
    EXPECT_EQ(read[i].block, tree.block_runs[i].block);
    EXPECT_EQ(read[i].cells, tree.block_runs[i].cells);
  }
}

TEST(BlockRuns, ArePossible) {
  TreeAttributes attributes;
  attributes.triangles = 2;
  attributes.quads = 3;
  const auto is_possible = [&](const std::vector<BlockRun>& runs) {
    try {
      require_possible_runs(runs, attributes, "a.tree.h5");
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  EXPECT_TRUE(is_possible({}));
  EXPECT_TRUE(is_possible({{3, 1, 2}, {4, 0, 1}, {4, 1, 2}}));
  EXPECT_FALSE(is_possible({{3, 1, 2}, {4, 0, 1}}));
  EXPECT_FALSE(is_possible({{3, 1, 2}, {5, 0, 3}}));
  EXPECT_FALSE(is_possible({{3, -1, 2}, {4, 0, 3}}));
  EXPECT_FALSE(is_possible({{3, 1, 1L << 62}, {3, 1, 1L << 62}, {4, 0, 3}}));
  EXPECT_FALSE(is_possible({{3, 1, 3}, {3, 1, -1}, {4, 0, 3}}));
}

/// Rank 0's, of a file that all ranks have written.
std::string bytes_at_root(const std::string& file) {
  std::ostringstream text;
  if (world().is_root()) text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The leaves shared out from the last rank on; none before.
TreeRecord tree_of_last_ranks() {
  TreeRecord tree = hand_made_tree();
  const std::int64_t first = world().size() - world().rank() - 1, all = 8;
  tree.leaves.clear();
  const std::vector<LeafRecord> whole = leaves();
  const std::int64_t ranks = std::min<std::int64_t>(3, world().size());
  if (first < ranks) {
    const std::int64_t part = ranks - 1 - first;
    tree.leaves.assign(whole.begin() + all * part / ranks, whole.begin() + all * (part + 1) / ranks);
  }
  return tree;
}

TEST(TreeFile, IsTheSameWhoeverHasTheLeaves) {
  const test::TemporaryFolder folder;
  write_tree(world(), hand_made_tree(), folder.file("a.tree.h5"));
  write_tree(world(), tree_of_last_ranks(), folder.file("b.tree.h5"));
  EXPECT_EQ(bytes_at_root(folder.file("a.tree.h5")), bytes_at_root(folder.file("b.tree.h5")));
}

TEST(TreeFile, IsTheSameWhereARankDoesNotReachTheFolder) {
  const test::TemporaryFolder folder;
  write_tree(world(), tree_of_last_ranks(), folder.file("a.tree.h5"));
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(world().rank() == world().size() - 1 && world().size() > 1
                                    ? std::filesystem::path("/")
                                    : std::filesystem::path(folder.file(".")));
  write_tree(world(), tree_of_last_ranks(), "b.tree.h5");
  std::filesystem::current_path(here);
  EXPECT_EQ(bytes_at_root(folder.file("a.tree.h5")), bytes_at_root(folder.file("b.tree.h5")));
}

TEST(TreeFile, CoursesOfWakesComeBackOnEveryRank) {
  const test::TemporaryFolder folder;
  TreeRecord tree = hand_made_tree();
  tree.measured.wakes = {{{0, 1}, {0.1, 1.5}}, {{3, 3}, {4, 3.5}, {5, 3.75}}};
  write_tree(world(), tree, folder.file("a.tree.h5"));
  EXPECT_EQ(read_tree(world(), folder.file("a.tree.h5")).measured, tree.measured);
  for (const Point bad : {Point{3, 3}, Point{0, std::nan("")}}) {
    tree.measured.wakes[1][1] = bad;
    write_tree(world(), tree, folder.file("bad.tree.h5"));
    try {
      read_tree(world(), folder.file("bad.tree.h5"));
      ADD_FAILURE();
    } catch (const InputError& fault) {
      EXPECT_NE(std::string(fault.what()).find("the wake from (3, 3) has an impossible point"),
                std::string::npos)
          << fault.what();
    }
  }
  EXPECT_THROW(possible_wakes({{0, 0}, {1, 0}, {2, 0}}, {2}, "a"), InputError);
  EXPECT_THROW(possible_wakes({{0, 0}, {1, 0}, {2, 0}}, {2, 1}, "a"), InputError);
  EXPECT_THROW(possible_wakes({{0, 0}, {1, 0}}, {3}, "a"), InputError);
}

TEST(TreeFile, AMeasuredWallComesBackOnEveryRank) {
  const test::TemporaryFolder folder;
  TreeRecord tree = hand_made_tree();
  write_tree(world(), tree, folder.file("without.tree.h5"));
  EXPECT_TRUE(read_tree(world(), folder.file("without.tree.h5")).measured.walls.empty());
  tree.measured.walls = {{{0, 1}, {0.1, 1.5}, 1e5, 2e5}, {{0.1, 1.5}, {0.25, 2}, 2e5, 0}};
  write_tree(world(), tree, folder.file("a.tree.h5"));
  EXPECT_EQ(read_tree(world(), folder.file("a.tree.h5")).measured.walls, tree.measured.walls);
  tree.measured.thickness = {{{0, 1}, {0.1, 1.5}, 0.01, 0.02}, {{0.1, 1.5}, {0.25, 2}, 0.02, 0}};
  write_tree(world(), tree, folder.file("both.tree.h5"));
  EXPECT_EQ(read_tree(world(), folder.file("both.tree.h5")).measured, tree.measured);
  tree.measured.walls[1].wall_units_to = -1;
  write_tree(world(), tree, folder.file("bad.tree.h5"));
  try {
    read_tree(world(), folder.file("bad.tree.h5"));
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_NE(std::string(fault.what()).find("the friction measured at (0.1, 1.5)"), std::string::npos);
  }
  tree.measured.walls.clear();
  tree.measured.thickness[0].at_from = -0.1;
  write_tree(world(), tree, folder.file("thin.tree.h5"));
  try {
    read_tree(world(), folder.file("thin.tree.h5"));
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_NE(std::string(fault.what()).find("the thickness measured at (0, 1)"), std::string::npos);
  }
}

}  // namespace
}  // namespace quadloop::io
