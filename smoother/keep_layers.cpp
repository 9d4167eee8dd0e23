#include "smoother/keep_layers.hpp"

#include <algorithm>
#include <limits>

#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::smoother {

namespace {

template <class Nodes>
bool is_stretched(const Mesh& mesh, const Nodes& nodes) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double edge = length(mesh.point(nodes[(k + 1) % nodes.size()]) - mesh.point(nodes[k]));
    shortest = std::min(shortest, edge);
    longest = std::max(longest, edge);
  }
  return longest > stretched_like_layers * shortest;
}

/// Files of earlier versions do not name strips.
bool may_have_unnamed_strips(const Mesh& mesh) { return has_layers(mesh) && mesh.strips.empty(); }

/// Whether a triangle touches a strip; flips would not restore the triangles that join a strip to the cells
/// outside.
bool touches_strip(const LayerPlaces& places, const std::array<NodeId, 3>& nodes) {
  return std::ranges::any_of(nodes, [&](NodeId node) { return places[node].strip >= 0; });
}

/// The nodes of this rank's stretched cells. *Collective.*
NodeFlags nodes_of_stretched(const Communicator& comm, const Mesh& mesh) {
  NodeFlags flags(mesh.points.size(), 0);
  if (!may_have_unnamed_strips(mesh)) return flags;
  std::vector<GlobalNodeId> nodes;
  const auto look_at = [&](const auto& cell) {
    if (!is_stretched(mesh, cell)) return;
    for (const NodeId node : cell) nodes.push_back(mesh.global(node));
  };
  mesh.for_each_cell(look_at);
  flag_at_owners(comm, NodeOwners(comm, mesh.first_node), nodes, flags);
  return flags;
}

}  // namespace

std::vector<std::int32_t> blocks_for_flips(const Communicator& comm, const Mesh& mesh,
                                           const LayerPlaces& places,
                                           const std::vector<std::int32_t>& given) {
  constexpr std::int64_t different = std::numeric_limits<std::int32_t>::max();
  const bool looks_at_shapes = may_have_unnamed_strips(mesh);
  std::vector<std::int32_t> blocks = given;
  blocks.resize(mesh.triangles.size(), 0);
  std::int64_t number = comm.exclusive_sum(std::ssize(mesh.triangles));
  for (std::size_t t = 0; t < blocks.size(); ++t, ++number) {
    const auto& nodes = mesh.triangles[t];
    if (is_layer_cell(places, nodes) || touches_strip(places, nodes) ||
        (looks_at_shapes && is_stretched(mesh, nodes)))
      blocks[t] = static_cast<std::int32_t>(-1 - number % different);
  }
  return blocks;
}

void keep_layers(const Communicator& comm, const Mesh& mesh, SmoothOptions& options) {
  if (!has_layers(mesh)) return;
  const LayerPlaces places = layer_places(comm, mesh);
  const NodeFlags stretched = nodes_of_stretched(comm, mesh);
  options.pinned.resize(mesh.owned_nodes, 0);
  for (const NodeId node : options.pinned.ids()) {
    if (places[node].valid() || stretched[node] != 0) options.pinned[node] = 1;
  }
  if (options.delaunay)
    options.triangle_to_block = blocks_for_flips(comm, mesh, places, options.triangle_to_block);
}

}  // namespace quadloop::smoother
