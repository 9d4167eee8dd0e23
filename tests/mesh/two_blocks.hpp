#pragma once

#include "mesher/mesh/scatter_blocks.hpp"
#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::test {

/// The grid as two blocks, "left" of the middle column and "right" of it; n is even. The edges between them
/// are the boundary "between", upwards.
inline Mesh two_blocks(const Grid& grid) {
  Mesh mesh = grid.mesh();
  mesh.blocks.names = {"left", "right"};
  const auto block_of = [&](const auto& nodes) {
    double x = 0;
    for (const NodeId node : nodes) x += mesh.point(node).x;
    return x / size32(nodes) < grid.size.x / 2 ? 0 : 1;
  };
  for (const auto& nodes : mesh.triangles) mesh.blocks.of_triangles.push_back(block_of(nodes));
  for (const auto& nodes : mesh.quads) mesh.blocks.of_quads.push_back(block_of(nodes));
  BoundaryEdges between{"between", BoundaryCondition::none, {}, {}, true};
  for (std::int32_t row = 0; row < grid.n; ++row) {
    const std::int32_t lower = row * (grid.n + 1) + grid.n / 2;
    between.edges.push_back({NodeId{lower}, NodeId{lower + grid.n + 1}});
  }
  mesh.boundaries.push_back(std::move(between));
  return mesh;
}

/// Distributes the mesh in the given order, with the block of each cell. *Collective.*
inline Mesh part_with_blocks(const Communicator& comm, const Mesh& whole, const MeshOrder& order) {
  Mesh part = scatter_mesh(comm, whole, order);
  part.blocks = scatter_blocks(comm, whole.blocks, order);
  return part;
}

}  // namespace quadloop::test
