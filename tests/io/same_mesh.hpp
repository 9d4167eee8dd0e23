#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::test {

/// Two meshes that are whole on this rank, with all that they have.
inline void expect_same(const io::LoadedMesh& found, const io::LoadedMesh& wanted) {
  EXPECT_EQ(found.mesh.points, wanted.mesh.points);
  EXPECT_EQ(found.mesh.triangles, wanted.mesh.triangles);
  EXPECT_EQ(found.mesh.quads, wanted.mesh.quads);
  EXPECT_EQ(found.blocks, wanted.blocks);
  EXPECT_EQ(found.block_names, wanted.block_names);
  EXPECT_EQ(found.triangle_to_block, wanted.triangle_to_block);
  EXPECT_EQ(found.quad_to_block, wanted.quad_to_block);
  const auto expect_same_edges = [](const std::vector<BoundaryEdges>& some,
                                    const std::vector<BoundaryEdges>& others) {
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t b = 0; b < some.size(); ++b) {
      EXPECT_EQ(some[b].name, others[b].name);
      EXPECT_EQ(some[b].condition, others[b].condition);
      EXPECT_EQ(some[b].edges, others[b].edges);
      EXPECT_EQ(some[b].layers, others[b].layers);
    }
  };
  expect_same_edges(found.mesh.boundaries, wanted.mesh.boundaries);
  expect_same_edges(found.inner_curves, wanted.inner_curves);
  EXPECT_EQ(found.mesh.strips, wanted.mesh.strips);
  EXPECT_EQ(found.mesh.pairs, wanted.mesh.pairs);
  EXPECT_EQ(found.mesh.named_nodes, wanted.mesh.named_nodes);
  EXPECT_EQ(found.periodic_nodes, wanted.periodic_nodes);
  EXPECT_EQ(found.warnings, wanted.warnings);
  ASSERT_EQ(found.solution.has_value(), wanted.solution.has_value());
  if (!found.solution) return;
  EXPECT_EQ(found.solution->names, wanted.solution->names);
  EXPECT_EQ(found.solution->values, wanted.solution->values);
  EXPECT_EQ(found.solution->constants, wanted.solution->constants);
  EXPECT_EQ(found.solution->cells.names, wanted.solution->cells.names);
  EXPECT_EQ(found.solution->cells.values, wanted.solution->cells.values);
}

}  // namespace quadloop::test
