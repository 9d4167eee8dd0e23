#include "io/loaded/interface_nodes.hpp"

#include <gtest/gtest.h>

#include "tests/mesh/grid_mesh.hpp"

namespace quadloop {
namespace {

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
}  // namespace quadloop
