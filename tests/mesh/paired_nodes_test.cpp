#include "mesher/mesh/paired_nodes.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/mixed_square.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// The square with a name for each side, south and north a pair.
Mesh paired_square() {
  Mesh mesh = test::mixed_square();
  const auto wall = mesh.boundaries[0].edges, far = mesh.boundaries[1].edges;
  mesh.boundaries = {{"south", {}, {wall[0], wall[1]}},
                     {"east", {}, {wall[2], wall[3]}},
                     {"north", {}, {far[0], far[1]}},
                     {"west", {}, {far[2], far[3]}}};
  mesh.pairs = {{"south", "north", {0, 2}}};
  return mesh;
}

TEST(PairedNodes, PartnersAreListedAlongTheFirstSide) {
  const Mesh whole = paired_square();
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  EXPECT_EQ(part.pairs, whole.pairs);
  const PairedNodes nodes = paired_nodes(world(), part, part.pairs[0]);
  EXPECT_EQ(nodes.from.points, (std::vector<Point>{{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_EQ(nodes.to.points, (std::vector<Point>{{0, 2}, {1, 2}, {2, 2}}));
  EXPECT_EQ(nodes.to.nodes, (std::vector<GlobalNodeId>{GlobalNodeId{6}, GlobalNodeId{7}, GlobalNodeId{8}}));
  EXPECT_EQ(gather_whole(world(), part).pairs, whole.pairs);
}

TEST(PairedNodes, AFaultNamesPlaceAndDistance) {
  Mesh whole = paired_square();
  whole.points[7].x = 1.25;
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const auto fault = fault_of_pair(world(), part, part.pairs[0]);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->place, (Point{1, 0}));
  EXPECT_NE(fault->what.find("0.25 from the node at (1.25, 2)"), std::string::npos) << fault->what;
  EXPECT_THROW(paired_nodes(world(), part, part.pairs[0]), InputError);
}

TEST(PairedNodes, ASideIsOneOpenLine) {
  Mesh whole = paired_square();
  whole.boundaries[0].edges.push_back(whole.boundaries[2].edges.back());
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  EXPECT_FALSE(line_of_boundary(world(), part, "south"));
  EXPECT_FALSE(line_of_boundary(world(), part, "nowhere"));
  EXPECT_TRUE(line_of_boundary(world(), part, "east"));
  EXPECT_TRUE(fault_of_pair(world(), part, part.pairs[0]));
}

TEST(PairedNodes, AQuarterTurnIsExact) {
  const PeriodicPair pair{"a", "b", {}, 90, {1, 1}};
  EXPECT_EQ(pair.image({3, 1}), (Point{1, 3}));
  EXPECT_EQ(pair.source({1, 3}), (Point{3, 1}));
}

TEST(PairedNodes, NodesOfBothSidesAreListedOnce) {
  Mesh mesh;
  const auto node = [](std::int32_t n) { return NodeId{n}; };
  mesh.boundaries = {{"a", {}, {{node(4), node(2)}, {node(2), node(3)}}},
                     {"b", {}, {{node(0), node(1)}}},
                     {"c", {}, {{node(7), node(8)}}}};
  mesh.pairs = {{"a", "b", {1, 0}}};
  EXPECT_EQ(nodes_on_sides(mesh), (std::vector<NodeId>{node(0), node(1), node(2), node(3), node(4)}));
}

}  // namespace
}  // namespace quadloop
