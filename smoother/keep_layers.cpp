#include "smoother/keep_layers.hpp"

#include <limits>

namespace quadloop {

std::vector<std::int32_t> blocks_for_flips(const Communicator& comm, const Mesh& mesh,
                                           const LayerPlaces& places,
                                           const std::vector<std::int32_t>& given) {
  constexpr std::int64_t different = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> blocks = given;
  blocks.resize(mesh.triangles.size(), 0);
  std::int64_t number = comm.exclusive_sum(std::ssize(mesh.triangles));
  for (std::size_t t = 0; t < blocks.size(); ++t, ++number) {
    if (is_layer_cell(places, mesh.triangles[t]))
      blocks[t] = static_cast<std::int32_t>(-1 - number % different);
  }
  return blocks;
}

void keep_layers(const Communicator& comm, const Mesh& mesh, SmoothOptions& options) {
  if (!has_layers(mesh)) return;
  const LayerPlaces places = layer_places(comm, mesh);
  options.pinned.resize(mesh.owned_nodes, 0);
  for (const NodeId node : options.pinned.ids()) {
    if (places[node].valid()) options.pinned[node] = 1;
  }
  if (options.delaunay)
    options.triangle_to_block = blocks_for_flips(comm, mesh, places, options.triangle_to_block);
}

}  // namespace quadloop
