#include "tests/mesh/mirrored_mesh.hpp"

#include <algorithm>

namespace quadloop::test {

Mesh with_image(const Mesh& half, MirrorAxis axis) {
  Mesh whole = half;
  IdVector<NodeId, NodeId> image(half.points.size());
  for (const NodeId node : image.ids()) {
    image[node] = node;
    if (side_of(axis, half.point(node)) == 0) continue;
    image[node] = NodeId{size32(whole.points)};
    whole.points.push_back(image_of(axis, half.point(node)));
  }
  whole.owned_nodes = size32(whole.points);
  const auto reflected = [&](auto nodes) {
    std::ranges::reverse(nodes);
    for (NodeId& node : nodes) node = image[node];
    return nodes;
  };
  for (const auto& t : half.triangles) whole.triangles.push_back(reflected(t));
  for (const auto& q : half.quads) whole.quads.push_back(reflected(q));
  for (BoundaryEdges& boundary : whole.boundaries) {
    std::erase_if(boundary.edges, [&](const auto& edge) {
      return side_of(axis, half.point(edge[0])) == 0 && side_of(axis, half.point(edge[1])) == 0;
    });
    const auto above = boundary.edges;
    for (const auto& edge : above) boundary.edges.push_back(reflected(edge));
  }
  return whole;
}

}  // namespace quadloop::test
