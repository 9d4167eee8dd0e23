#include "flow/postprocess/nodes_above_walls.hpp"

namespace quadloop::flow {

NodesAboveWalls nodes_above(const HaloMesh& mesh, const std::vector<char>& is_wall) {
  std::vector<Point> inward(mesh.points().size());
  for (const HaloEdge& edge : mesh.boundary_edges()) {
    if (is_wall[edge.boundary] == 0) continue;
    const Point along = mesh.point(edge.to) - mesh.point(edge.from);
    for (const NodeId node : {edge.from, edge.to})
      inward[node.value()] = inward[node.value()] + Point{-along.y, along.x};
  }
  const std::size_t owned = mesh.owned_nodes();
  NodesAboveWalls above{std::vector<double>(owned, 0.0), std::vector<NodeId>(owned, NodeId{0}),
                        std::vector<Point>(owned)};
  std::vector<double> upright(owned, 0.0);
  mesh.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const std::size_t next : {k + 1, k + nodes.size() - 1}) {
        const NodeId node = nodes[k], other = nodes[next % nodes.size()];
        const double size = length(inward[node.value()]);
        if (!mesh.owns(node) || size == 0) continue;
        above.inward[node.value()] = (1 / size) * inward[node.value()];
        const Point there = mesh.point(other) - mesh.point(node);
        const double height = dot(there, inward[node.value()]) / size, cosine = height / length(there);
        if (!(cosine > upright[node.value()])) continue;
        upright[node.value()] = cosine;
        above.heights[node.value()] = height;
        above.nodes[node.value()] = other;
      }
    }
  });
  return above;
}

}  // namespace quadloop::flow
