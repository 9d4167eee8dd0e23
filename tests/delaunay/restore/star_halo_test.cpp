// Triangles fetched ring by ring, wherever they are kept.
#include "mesher/delaunay/restore/star_halo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// All triangles of a grid, on every rank, and where nodes and triangles are kept: nodes in stretches,
/// triangles anywhere.
struct SpreadGrid {
  SpreadGrid() {
    const Mesh whole = test::Grid{7, {1, 1}, false}.mesh();
    nodes = whole.owned_nodes;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
      NumberedTriangle triangle;
      triangle.number = static_cast<std::int64_t>(t);
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.nodes[k] = whole.global(whole.triangles[t][k]);
        triangle.points[k] = whole.point(whole.triangles[t][k]);
      }
      all.push_back(triangle);
      if (static_cast<int>(t * 7 % 11) % world().size() == world().rank()) own.push_back(triangle);
    }
  }
  std::int64_t first_of(int rank) const { return nodes * rank / world().size(); }

  std::int64_t nodes = 0;
  std::vector<NumberedTriangle> all, own;
  NodeOwners owners{world(), first_of_own()};

 private:
  std::int64_t first_of_own() const { return std::int64_t{64} * world().rank() / world().size(); }
};

std::set<std::int64_t> numbers_of(std::span<const NumberedTriangle> triangles) {
  std::set<std::int64_t> numbers;
  for (const NumberedTriangle& t : triangles) numbers.insert(t.number);
  EXPECT_EQ(numbers.size(), triangles.size()) << "each once";
  return numbers;
}

/// Of all triangles those with one of these nodes.
std::set<std::int64_t> round(const SpreadGrid& grid, const std::set<GlobalNodeId>& nodes) {
  std::set<std::int64_t> found;
  for (const NumberedTriangle& t : grid.all) {
    if (std::any_of(t.nodes.begin(), t.nodes.end(), [&](GlobalNodeId n) { return nodes.contains(n); }))
      found.insert(t.number);
  }
  return found;
}

TEST(StarHalo, GrowsARingAtATimeUntilAllIsThere) {
  const SpreadGrid grid;
  ASSERT_EQ(grid.nodes, 64);
  StarHalo halo(world(), grid.owners, grid.own);
  std::set<GlobalNodeId> known;
  for (const GlobalNodeId n : ids_below(GlobalNodeId{grid.nodes})) {
    EXPECT_EQ(halo.owns(n), grid.owners.rank_of(n) == world().rank());
    if (halo.owns(n)) known.insert(n);
  }
  for (int ring = 0; ring < 8; ++ring) {
    const auto expected = round(grid, known);
    EXPECT_EQ(numbers_of(halo.triangles()), expected) << "ring " << ring;
    std::set<GlobalNodeId> at_hand;
    for (const NumberedTriangle& t : halo.triangles()) at_hand.insert(t.nodes.begin(), t.nodes.end());
    EXPECT_EQ(halo.complete(), at_hand == known);
    for (const NumberedTriangle& t : halo.triangles()) {
      const auto unknown =
          std::count_if(t.nodes.begin(), t.nodes.end(), [&](GlobalNodeId n) { return !known.contains(n); });
      EXPECT_EQ(halo.at_rim(t), unknown > 1);
    }
    known.merge(at_hand);
    halo.grow(true);
  }
  EXPECT_TRUE(halo.complete());
  EXPECT_EQ(halo.triangles().size(), known.empty() ? 0 : grid.all.size());
}

TEST(StarHalo, GrowsWhereItIsWantedAlone) {
  const SpreadGrid grid;
  StarHalo halo(world(), grid.owners, grid.own);
  const auto before = numbers_of(halo.triangles());
  halo.grow(world().rank() == 1);
  if (world().rank() == 1) {
    EXPECT_GT(halo.triangles().size(), before.size());
  } else {
    EXPECT_EQ(numbers_of(halo.triangles()), before);
  }
}

TEST(StarHalo, ARegionMayBeEmpty) {
  const SpreadGrid grid;
  StarHalo halo(world(), grid.owners, {});
  halo.grow(true);
  EXPECT_TRUE(halo.triangles().empty());
  EXPECT_TRUE(halo.complete());
}

}  // namespace
}  // namespace quadloop
