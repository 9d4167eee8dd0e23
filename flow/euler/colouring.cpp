#include "flow/euler/colouring.hpp"

#include <numeric>

namespace quadloop::euler {

Colouring colour_edges(const Communicator& comm, const DualMesh& mesh) {
  std::vector<std::vector<std::int32_t>> neighbours(mesh.owned_nodes());
  for (const DualEdge& edge : mesh.edges()) {
    if (mesh.is_owned(edge.low)) neighbours[edge.low].push_back(edge.high);
    if (mesh.is_owned(edge.high)) neighbours[edge.high].push_back(edge.low);
  }
  std::vector<std::int32_t> owned(neighbours.size());
  std::iota(owned.begin(), owned.end(), 0);
  return colour_nodes(
      comm, mesh.exchange(), mesh.nodes(), [&](std::int32_t node) { return mesh.global(node); }, owned,
      [&](std::size_t node, const auto& visit) {
        for (const std::int32_t other : neighbours[node]) visit(other);
      });
}

}  // namespace quadloop::euler
