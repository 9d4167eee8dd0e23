#include "io/model/interface_nodes.hpp"

#include <gtest/gtest.h>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

/// Two squares that touch along x = 1, each with its own nodes there.
TEST(NodesThatStay, AreThoseOfInterfacesAndCracks) {
  LoadedMesh loaded;
  loaded.mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}};
  loaded.mesh.quads = {{test::node(0), test::node(1), test::node(2), test::node(3)},
                       {test::node(4), test::node(5), test::node(6), test::node(7)}};
  loaded.quad_to_block = {0, 0};
  const NodeFlags flags = nodes_that_stay(loaded);
  EXPECT_EQ(std::vector<char>(flags.begin(), flags.end()), (std::vector<char>{0, 1, 1, 0, 1, 0, 0, 1}));
  loaded.mesh.points[4].x = loaded.mesh.points[7].x = 1.5;
  EXPECT_TRUE(nodes_that_stay(loaded).empty());
}

TEST(InterfaceNodes, AreThoseThatCellsOfTwoBlocksShare) {
  LoadedMesh loaded;
  const test::Grid grid{4};
  loaded.mesh = grid.mesh();
  loaded.blocks = 2;
  const auto block_of = [&](const auto& nodes) {
    double x = 0;
    for (const NodeId node : nodes) x += loaded.mesh.point(node).x / size32(nodes);
    return x < 0.5 ? 0 : 1;
  };
  for (const auto& nodes : loaded.mesh.triangles) loaded.triangle_to_block.push_back(block_of(nodes));
  for (const auto& nodes : loaded.mesh.quads) loaded.quad_to_block.push_back(block_of(nodes));
  const NodeFlags shared = interface_nodes(loaded);
  for (const NodeId node : shared.ids()) EXPECT_EQ(shared[node] != 0, loaded.mesh.point(node).x == 0.5);
}

}  // namespace
}  // namespace quadloop::io
