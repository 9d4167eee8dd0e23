// Edges of cells, owners of nodes.
#include "mesher/mesh/topology.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mesher/mesh/node_exchange.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/node.hpp"
#include "tests/mesh/square_and_triangle.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::node;
using test::world;

TEST(EdgeTable, KnowsTheCellLeftOfEachEdge) {
  const EdgeTable table(test::square_and_triangle());
  EXPECT_EQ(table.cell_left_of(node(2), node(1)), 0) << "the triangle";
  EXPECT_EQ(table.cell_left_of(node(1), node(2)), 1) << "the quad";
  EXPECT_EQ(table.cell_left_of(node(1), node(0)), -1) << "outside";
  EXPECT_EQ(table.cell_left_of(node(0), node(2)), -1) << "no edge";
  EXPECT_EQ(table.from(node(1)).size(), 2U);
  EXPECT_EQ(table.from(node(4)).size(), 1U);
}

TEST(EdgeTable, OfAGridHasEveryEdgeOfEveryCell) {
  const Mesh mesh = test::Grid{9, {1, 1}, false}.mesh();
  const EdgeTable table(mesh);
  std::size_t edges = 0;
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    EXPECT_EQ(table.cell_left_of(from, to), cell);
    ++edges;
  });
  EXPECT_EQ(edges, 3 * mesh.triangles.size() + 4 * mesh.quads.size());
  std::size_t listed = 0;
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) listed += table.from(node(n)).size();
  EXPECT_EQ(listed, edges);
}

TEST(EdgeTable, TheFirstOfTwoCellsOnOneSideIsFound) {
  Mesh mesh = test::square_and_triangle();
  mesh.triangles.push_back(mesh.triangles.front());
  const EdgeTable table(mesh);
  EXPECT_EQ(table.cell_left_of(node(2), node(1)), 0);
  EXPECT_EQ(table.from(node(4)).size(), 2U);
}

TEST(EdgeTable, NodesWithoutCellsHaveNoEdges) {
  Mesh mesh;
  EXPECT_NO_THROW(EdgeTable{mesh});
  mesh.points.push_back({0, 0});
  EXPECT_TRUE(EdgeTable(mesh).from(node(0)).empty());
}

/// Ranks own rank % 3 * 2 nodes, so that some own none.
TEST(NodeOwners, PassOverRanksWithoutNodes) {
  const std::int64_t own = world().rank() % 3 * 2, first = world().exclusive_sum(own);
  const NodeOwners owners(world(), first);
  const auto counts = world().all_gather(own);
  std::int64_t number = 0;
  for (int rank = 0; rank < world().size(); ++rank) {
    for (std::int32_t i = 0; i < counts[rank]; ++i, ++number) {
      EXPECT_EQ(owners.rank_of(GlobalNodeId{number}), rank);
      EXPECT_EQ(owners.local(GlobalNodeId{number}), NodeId{i});
    }
  }
}

TEST(NodeExchange, GhostsGetWhatTheirOwnersHave) {
  const std::int32_t own = 3;
  const NodeOwners owners(world(), own * world().rank());
  std::vector<GlobalNodeId> ghosts;  // every other rank's nodes, backwards
  for (std::int64_t number = own * world().size() - 1; number >= 0; --number) {
    if (number / own != world().rank()) ghosts.push_back(GlobalNodeId{number});
  }
  const NodeExchange exchange(world(), owners, own, ghosts);
  std::vector<std::int64_t> values;
  for (std::int32_t i = 0; i < own; ++i) values.push_back(own * world().rank() + i);
  values.resize(own + ghosts.size(), -1);
  exchange.update(values);
  for (std::size_t i = 0; i < ghosts.size(); ++i) EXPECT_EQ(values[own + i], ghosts[i].value());
}

}  // namespace
}  // namespace quadloop
