// Triangles fetched ring by ring, wherever they are kept.
#include "mesher/delaunay/restore/star_halo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "mesher/mesh/node_table.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// All triangles of a grid, on every rank, and where nodes and triangles are kept: nodes in stretches,
/// triangles anywhere, or in stretches that lie with another rank than most of their nodes do.
struct SpreadGrid {
  explicit SpreadGrid(bool in_stretches = false) {
    first_node = mesh.first_node = whole.owned_nodes * world().rank() / world().size();
    mesh.owned_nodes =
        static_cast<std::int32_t>(whole.owned_nodes * (world().rank() + 1) / world().size() - first_node);
    const auto own = whole.points.begin() + first_node;
    mesh.points.assign(own, own + mesh.owned_nodes);
    NodeTable table(mesh);
    for (int rank = 0; rank < world().size(); ++rank) {  // numbers follow the order of ranks
      for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        if (rank_of(t, in_stretches) != rank) continue;
        all.push_back(whole.triangles[t]);
        if (rank != world().rank()) continue;
        auto& own_triangle = mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
          own_triangle[k] = table.local(whole.global(all.back()[k]), whole.point(all.back()[k]));
      }
    }
  }
  int rank_of(std::size_t t, bool in_stretches) const {
    const auto ranks = static_cast<std::size_t>(world().size());
    const std::size_t place = in_stretches ? t * ranks / whole.triangles.size() + 1 : t * 7 % 11;
    return static_cast<int>(place % ranks);
  }
  NodeFlags flags(char value) const { return NodeFlags(mesh.points.size(), value); }

  const Mesh whole = test::Grid{7, {1, 1}, false}.mesh();
  std::vector<std::array<NodeId, 3>> all;  ///< by their numbers
  std::int64_t first_node = 0;
  Mesh mesh;
};

const std::vector<std::int32_t> no_blocks;
const NodeFlags all_moved;

std::set<std::int64_t> numbers_of(const StarHalo& halo) {
  std::set<std::int64_t> numbers;
  for (std::size_t i = 0; i < halo.triangles().size(); ++i) numbers.insert(halo.number(i));
  EXPECT_EQ(numbers.size(), halo.triangles().size()) << "each once";
  return numbers;
}

/// Of all triangles those with one of these nodes.
std::set<std::int64_t> round(const SpreadGrid& grid, const std::set<GlobalNodeId>& nodes) {
  std::set<std::int64_t> found;
  for (std::size_t i = 0; i < grid.all.size(); ++i) {
    const auto& t = grid.all[i];
    if (std::any_of(t.begin(), t.end(), [&](NodeId n) { return nodes.contains(grid.whole.global(n)); }))
      found.insert(static_cast<std::int64_t>(i));
  }
  return found;
}

/// The nodes of a triangle are those that its number says, and lie where they do.
void expect_named(const SpreadGrid& grid, const StarHalo& halo, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k) {
    const NodeId node = grid.all[halo.number(i)][k];
    EXPECT_EQ(halo.global(halo.triangles()[i][k]), grid.whole.global(node));
    EXPECT_EQ(halo.points()[halo.triangles()[i][k]], grid.whole.point(node));
  }
}

TEST(StarHalo, GrowsARingAtATimeUntilAllIsThere) {
  const SpreadGrid grid;
  const NodeOwners owners(world(), grid.first_node);
  StarHalo halo(world(), owners, grid.mesh, grid.flags(1), {no_blocks, all_moved}, {});
  std::set<GlobalNodeId> known;
  for (std::int32_t n = 0; n < grid.mesh.owned_nodes; ++n) known.insert(grid.mesh.global(NodeId{n}));
  for (int ring = 0; ring < 8; ++ring) {
    const auto expected = round(grid, known);
    EXPECT_EQ(numbers_of(halo), expected) << "ring " << ring;
    std::set<GlobalNodeId> at_hand;
    for (std::size_t i = 0; i < halo.triangles().size(); ++i) {
      expect_named(grid, halo, i);
      std::ptrdiff_t unknown = 0;
      for (const std::int32_t n : halo.triangles()[i]) {
        at_hand.insert(halo.global(n));
        unknown += known.contains(halo.global(n)) ? 0 : 1;
        EXPECT_TRUE(halo.is_core(n));
      }
      EXPECT_EQ(halo.at_rim(i), unknown > 1);
    }
    EXPECT_EQ(halo.complete(), std::includes(known.begin(), known.end(), at_hand.begin(), at_hand.end()));
    known.merge(at_hand);
    halo.grow(true);
  }
  EXPECT_TRUE(halo.complete());
  EXPECT_EQ(halo.triangles().size(), known.empty() ? 0 : grid.all.size());
}

TEST(StarHalo, GrowsWhereItIsWantedAlone) {
  const SpreadGrid grid;
  const NodeOwners owners(world(), grid.first_node);
  StarHalo halo(world(), owners, grid.mesh, grid.flags(1), {no_blocks, all_moved}, {});
  const auto before = numbers_of(halo);
  halo.grow(world().rank() == 1);
  if (world().rank() == 1) {
    EXPECT_GT(halo.triangles().size(), before.size());
  } else {
    EXPECT_EQ(numbers_of(halo), before);
  }
}

/// Only triangles around core nodes; what is known of nodes and triangles comes with them.
TEST(StarHalo, FlagsAndBlocksTravel) {
  const SpreadGrid grid(true);
  const NodeOwners owners(world(), grid.first_node);
  const auto is_core = [](GlobalNodeId n) { return n.value() % 9 < 3; };
  const auto has_moved = [](GlobalNodeId n) { return n.value() % 4 == 1; };
  const auto block_of = [](GlobalNodeId first) { return static_cast<std::int32_t>(first.value() % 3); };
  NodeFlags core = grid.flags(0), moved = grid.flags(0);
  for (const NodeId n : core.ids()) {
    core[n] = is_core(grid.mesh.global(n)) ? 1 : 0;
    moved[n] = has_moved(grid.mesh.global(n)) ? 1 : 0;
  }
  std::vector<std::int32_t> blocks;
  for (const auto& t : grid.mesh.triangles) blocks.push_back(block_of(grid.mesh.global(t[0])));
  StarHalo halo(world(), owners, grid.mesh, core, {blocks, moved}, {});
  for (int ring = 0; ring < 8; ++ring) halo.grow(true);
  for (std::size_t i = 0; i < halo.triangles().size(); ++i) {
    bool any_core = false;
    for (const std::int32_t n : halo.triangles()[i]) {
      EXPECT_EQ(halo.is_core(n), is_core(halo.global(n)));
      EXPECT_EQ(halo.moved()[n] != 0, has_moved(halo.global(n)));
      any_core = any_core || halo.is_core(n);
    }
    EXPECT_TRUE(any_core);
    EXPECT_EQ(halo.blocks()[i], block_of(halo.global(halo.triangles()[i][0])));
  }
  if (grid.mesh.owned_nodes > 3) {
    EXPECT_FALSE(halo.triangles().empty());
  }
}

TEST(StarHalo, ARegionMayBeEmpty) {
  const SpreadGrid grid;
  const NodeOwners owners(world(), grid.first_node);
  StarHalo halo(world(), owners, grid.mesh, grid.flags(0), {no_blocks, all_moved}, {});
  halo.grow(true);
  EXPECT_TRUE(halo.triangles().empty());
  EXPECT_TRUE(halo.complete());
}

}  // namespace
}  // namespace quadloop
