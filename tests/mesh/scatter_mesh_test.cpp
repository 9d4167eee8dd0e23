// A mesh that the root holds whole comes back as it was from any number of ranks and in any order.
#include "mesher/mesh/scatter_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/node_table.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Mesh jittered(std::int32_t n) {
  const test::Grid grid{n};
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.2, 3, mesh);
  return mesh;
}

/// What a rank is told of the whole mesh: all on the root, nothing elsewhere.
template <class T>
T on_root(const T& value) {
  return world().is_root() ? value : T{};
}

void expect_permutation(std::vector<std::int32_t> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(order[i], static_cast<std::int32_t>(i));
}

TEST(SpaceFillingOrder, IsAPermutation) {
  for (const std::int32_t n : {1, 2, 9}) {
    const Mesh whole = jittered(n);
    const MeshOrder order = space_filling_order(whole);
    expect_permutation(order.nodes, whole.points.size());
    expect_permutation(order.triangles, whole.triangles.size());
    expect_permutation(order.quads, whole.quads.size());
  }
}

TEST(SpaceFillingOrder, KeepsNeighboursTogether) {
  const test::Grid grid{15};
  const MeshOrder order = space_filling_order(grid.mesh());
  for (std::size_t begin = 0; begin < order.nodes.size();
       begin += 64) {  // 16 x 16 nodes: each quarter is one run of the curve
    Box box;
    for (std::size_t i = begin; i < begin + 64; ++i) box.include(grid.place(order.nodes[i]));
    EXPECT_LT(std::max(box.width(), box.height()), 0.5);
  }
}

TEST(OrderForParts, IsTheMeshsOwnWhereNeighboursStandTogether) {
  const Mesh rows = jittered(15);
  const Communicator self(MPI_COMM_SELF);
  const Mesh along = scatter_mesh(self, rows, space_filling_order(rows)),
             mixed = scatter_mesh(self, rows, test::shuffled_order(rows, 5));
  EXPECT_EQ(order_for_parts(along).nodes, own_order(along).nodes);
  EXPECT_EQ(order_for_parts(along).triangles, own_order(along).triangles);
  EXPECT_EQ(order_for_parts(mixed).nodes, space_filling_order(mixed).nodes);
}

TEST(SpaceFillingOrder, IsThatOfTheMeshAlone) {
  Mesh flat = jittered(3);
  for (Point& p : flat.points) p = {5, 5};  // a box without extent
  const MeshOrder order = space_filling_order(flat);
  for (std::size_t i = 0; i < order.nodes.size(); ++i)
    EXPECT_EQ(order.nodes[i], static_cast<std::int32_t>(i));
}

void expect_round_trip(const Mesh& whole, const MeshOrder& order) {
  const Mesh part = scatter_mesh(world(), on_root(whole), on_root(order));
  Mesh back = on_root(whole);
  for (Point& p : back.points) p = {};
  for (auto& t : back.triangles) t = {};
  for (auto& q : back.quads) q = {};
  gather_mesh(world(), part, on_root(order), back);
  if (!world().is_root()) return;
  EXPECT_TRUE(back.points == whole.points);
  EXPECT_TRUE(back.triangles == whole.triangles);
  EXPECT_TRUE(back.quads == whole.quads);
}

TEST(ScatterMesh, GatherGivesItBack) {
  for (const std::int32_t n : {1, 2, 7}) {  // four nodes are fewer than five ranks
    const Mesh whole = jittered(n);
    expect_round_trip(whole, space_filling_order(whole));
    expect_round_trip(whole, test::shuffled_order(whole, 4));
  }
}

TEST(ScatterMesh, SharesAreEven) {
  const Mesh whole = jittered(7);
  const Mesh part = scatter_mesh(world(), on_root(whole), on_root(space_filling_order(whole)));
  const auto expect_share = [&](std::size_t own, std::size_t all) {
    EXPECT_EQ(world().sum(static_cast<std::int64_t>(own)), static_cast<std::int64_t>(all));
    EXPECT_LE(std::abs(static_cast<double>(own) - static_cast<double>(all) / world().size()), 1.0);
  };
  expect_share(static_cast<std::size_t>(part.owned_nodes), whole.points.size());
  expect_share(part.triangles.size(), whole.triangles.size());
  expect_share(part.quads.size(), whole.quads.size());
  EXPECT_EQ(part.first_node, world().exclusive_sum(part.owned_nodes));
}

TEST(ScatterMesh, PartsNameTheNodesOfTheWhole) {
  const Mesh whole = jittered(7);
  const MeshOrder order = test::shuffled_order(whole, 9);
  const Mesh part = scatter_mesh(world(), on_root(whole), on_root(order));
  ASSERT_EQ(part.points.size(), static_cast<std::size_t>(part.owned_nodes) + part.ghosts.size());
  std::set<std::int64_t> numbers;
  for (std::int32_t i = 0; i < size32(part.points); ++i) {
    const std::int64_t number = part.global(NodeId{i}).value();
    EXPECT_TRUE(numbers.insert(number).second) << number << " twice";
    EXPECT_EQ(part.point(NodeId{i}), whole.points[order.nodes[number]]);
  }
}

TEST(ScatterMesh, BoundariesAreOnEveryRank) {
  const Mesh whole = jittered(7);
  const MeshOrder order = space_filling_order(whole);
  const Mesh part = scatter_mesh(world(), on_root(whole), on_root(order));
  ASSERT_EQ(part.boundaries.size(), whole.boundaries.size());
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b) {
    EXPECT_EQ(part.boundaries[b].name, whole.boundaries[b].name);
    EXPECT_EQ(part.boundaries[b].condition, whole.boundaries[b].condition);
    std::vector<std::array<NodeId, 2>> edges;
    for (const auto& edge : part.boundaries[b].edges) {
      edges.push_back(edge);
      for (NodeId& node : edges.back()) node = NodeId{order.nodes[part.global(node).value()]};
    }
    EXPECT_TRUE(world().all_gather_values(std::span<const std::array<NodeId, 2>>(edges)) ==
                whole.boundaries[b].edges);
  }
}

TEST(ScatterMesh, GatherTakesWhatHasChanged) {
  const Mesh whole = jittered(4);
  const MeshOrder order = test::shuffled_order(whole, 2);
  Mesh part = scatter_mesh(world(), on_root(whole), on_root(order)), back = on_root(whole);
  for (Point& p : part.points) p = p + Point{1, 2};
  for (auto& t : part.triangles) t = {t[1], t[2], t[0]};
  gather_mesh(world(), part, on_root(order), back);
  for (std::size_t i = 0; i < back.points.size(); ++i)
    EXPECT_EQ(back.points[i], whole.points[i] + (Point{1, 2}));
  for (std::size_t i = 0; i < back.triangles.size(); ++i) {
    EXPECT_EQ(back.triangles[i],
              (std::array<NodeId, 3>{whole.triangles[i][1], whole.triangles[i][2], whole.triangles[i][0]}));
  }
}

TEST(ScatterNodes, FollowsTheNodes) {
  const Mesh whole = jittered(6);
  const MeshOrder order = test::shuffled_order(whole, 5);
  const Mesh part = scatter_mesh(world(), on_root(whole), on_root(order));
  std::vector<double> of_whole;
  for (const Point& p : whole.points) of_whole.push_back(p.x);
  const auto own = scatter_nodes(world(), on_root(of_whole), on_root(order));
  ASSERT_EQ(own.size(), static_cast<std::size_t>(part.owned_nodes));
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(own[i], part.points[i].x);
  EXPECT_TRUE(scatter_nodes(world(), std::vector<char>{}, on_root(order)).empty());
}

TEST(BoxOverRanks, HoldsAllRanksPoints) {
  const double rank = world().rank();
  std::vector<Point> points;
  if (world().rank() % 2 == 0) points = {{rank, -rank}, {-1, 2}};  // the others have none
  const Box box = box_over_ranks(world(), points);
  const double last = world().size() - 1 - (world().size() - 1) % 2;
  EXPECT_EQ(box.low, (Point{-1, -last}));
  EXPECT_EQ(box.high, (Point{last, 2}));
}

TEST(NodeTable, KnowsOwnedNodesAndLearnsGhosts) {
  Mesh part;
  part.first_node = 10;
  part.owned_nodes = 2;
  part.points = {{0, 0}, {1, 0}, {2, 0}};
  part.ghosts = {GlobalNodeId{3}};
  NodeTable nodes(part);
  EXPECT_EQ(nodes.find(GlobalNodeId{11}), NodeId{1});
  EXPECT_EQ(nodes.find(GlobalNodeId{3}), NodeId{2});
  EXPECT_FALSE(nodes.find(GlobalNodeId{12}).valid());
  EXPECT_FALSE(nodes.find(GlobalNodeId{9}).valid());
  EXPECT_EQ(nodes.local(GlobalNodeId{12}, {5, 5}), NodeId{3});
  EXPECT_EQ(nodes.find(GlobalNodeId{12}), NodeId{3});
  EXPECT_EQ(nodes.local(GlobalNodeId{12}, {6, 6}), NodeId{3});
  EXPECT_EQ(part.ghosts.back(), GlobalNodeId{12});
  EXPECT_EQ(part.points.back(), (Point{5, 5}));
}

}  // namespace
}  // namespace quadloop
