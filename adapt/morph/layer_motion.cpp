#include "adapt/morph/layer_motion.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace quadloop::adapt {

namespace {

/// Returns for each owned node in layers the next node of its column towards the wall: along the shortest
/// edge that leads one layer down, as diagonals are longer.
IdVector<NodeId, NodeId> nodes_below(const HaloMesh& mesh, const LayerPlaces& places) {
  IdVector<NodeId, NodeId> below(mesh.owned_nodes(), NodeId{});
  const auto edge = [&](NodeId a, NodeId b) {
    return std::tuple(length(mesh.point(b) - mesh.point(a)), mesh.global(b));
  };
  const auto offer = [&](NodeId node, NodeId other) {
    if (!mesh.owns(node)) return;
    const LayerPlace& place = places[node];
    if (!place.valid() || places[other] != LayerPlace{place.left + 1, place.boundary, place.strip}) return;
    if (!below[node].valid() || edge(node, other) < edge(node, below[node])) below[node] = other;
  };
  mesh.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
      offer(a, b);
      offer(b, a);
    }
  });
  return below;
}

}  // namespace

void find_feet(const Communicator& comm, const HaloMesh& mesh, const LayerPlaces& places, NodeFeet& feet) {
  std::int32_t most = -1;
  for (const NodeId node : places.ids()) most = std::max(most, places[node].left);
  most = static_cast<std::int32_t>(comm.maximum(std::int64_t{most}));
  if (most < 0) return;
  const IdVector<NodeId, NodeId> below = nodes_below(mesh, places);
  std::vector<std::vector<NodeId>> by_layers_left(most + 1);
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (below[node].valid() && feet[node] < 0) by_layers_left[places[node].left].push_back(node);
  }
  for (std::int32_t left = most; left >= 0; --left) {
    for (const NodeId node : by_layers_left[left]) feet[node] = feet[below[node]];
    mesh.exchange().update(feet);
  }
}

}  // namespace quadloop::adapt
