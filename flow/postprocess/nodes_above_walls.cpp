#include "flow/postprocess/nodes_above_walls.hpp"

#include <array>
#include <set>

#include "mesher/mesh/wake_roots.hpp"

namespace quadloop::flow {

namespace {

/// Sets the entries of roots of wakes.
void set_at_roots(const HaloMesh& mesh, const std::vector<char>& is_wall, const std::set<GlobalNodeId>& roots,
                  NodesAboveWalls& above) {
  const auto is_root = [&](NodeId node) { return mesh.owns(node) && roots.contains(mesh.global(node)); };
  std::set<std::array<NodeId, 2>> edges;
  for (const HaloEdge& edge : mesh.boundary_edges()) {
    if (is_wall[edge.boundary] == 0 || !(is_root(edge.from) || is_root(edge.to))) continue;
    edges.insert({edge.from, edge.to});
    for (const NodeId node : {edge.from, edge.to}) {
      if (is_root(node)) above.heights[node.value()] = 0;
    }
  }
  const auto lower = [&](NodeId root, NodeId other, const std::array<NodeId, 2>& edge) {
    if (!is_root(root)) return;
    const Point along = mesh.point(edge[1]) - mesh.point(edge[0]);
    const double size = length(along), height = cross(along, mesh.point(other) - mesh.point(root)) / size;
    double& least = above.heights[root.value()];
    if (!(height > 0) || (least > 0 && least <= height)) return;
    least = height;
    above.nodes[root.value()] = other;
    above.inward[root.value()] = (1 / size) * Point{-along.y, along.x};
  };
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t corners = nodes.size();
    for (std::size_t k = 0; k < corners; ++k) {
      const std::array edge{nodes[k], nodes[(k + 1) % corners]};
      if (!edges.contains(edge)) continue;
      lower(edge[0], nodes[(k + corners - 1) % corners], edge);
      lower(edge[1], nodes[(k + 2) % corners], edge);
    }
  });
}

}  // namespace

NodesAboveWalls nodes_above(const HaloMesh& mesh, const std::vector<char>& is_wall,
                            const std::vector<StripLayers>& strips) {
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
  if (const std::set<GlobalNodeId> roots = wake_roots(strips); !roots.empty())
    set_at_roots(mesh, is_wall, roots, above);
  return above;
}

}  // namespace quadloop::flow
