#include "flow/euler/implicit/colouring.hpp"

#include <algorithm>

namespace quadloop::flow::euler {

Colouring colour_dual_nodes(const Communicator& comm, const DualMesh& mesh) {
  IdVector<NodeId, std::vector<NodeId>> neighbours(mesh.owned_nodes());
  for (const DualEdge& edge : mesh.edges()) {
    if (mesh.is_owned(edge.low)) neighbours[edge.low].push_back(edge.high);
    if (mesh.is_owned(edge.high)) neighbours[edge.high].push_back(edge.low);
  }
  std::vector<NodeId> owned;
  std::ranges::copy(mesh.owned_ids(), std::back_inserter(owned));
  return colour_nodes(comm, mesh.halo(), owned, [&](std::size_t i, const auto& visit) {
    std::ranges::for_each(neighbours[owned[i]], visit);
  });
}

}  // namespace quadloop::flow::euler
