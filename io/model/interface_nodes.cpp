#include "io/model/interface_nodes.hpp"

#include "mesher/geometry/point_table.hpp"

namespace quadloop::io {

NodeFlags interface_nodes(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  IdVector<NodeId, std::int32_t> block_of(mesh.points.size(), -1);
  NodeFlags shared(mesh.points.size(), 0);
  const auto visit = [&](const auto& cells, const std::vector<std::int32_t>& blocks) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      for (const NodeId node : cells[cell]) {
        std::int32_t& block = block_of[node];
        if (block >= 0 && block != blocks[cell]) shared[node] = 1;
        block = blocks[cell];
      }
    }
  };
  visit(mesh.triangles, loaded.triangle_to_block);
  visit(mesh.quads, loaded.quad_to_block);
  return shared;
}

NodeFlags nodes_that_stay(const LoadedMesh& loaded) {
  const std::vector<Point>& points = loaded.mesh.points;
  const PointTable table(points);
  if (loaded.blocks == 1 && !table.any_twice()) return {};
  NodeFlags flags = interface_nodes(loaded);
  for (const NodeId node : flags.ids()) {
    const NodeId first{table.find(points[node.value()])};
    if (first != node) flags[node] = flags[first] = 1;
  }
  return flags;
}

}  // namespace quadloop::io
