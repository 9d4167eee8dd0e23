#include "io/model/distribute.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "io/model/mesh_of_file.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::io {

namespace {

/// Takes the inner lines, which are the last boundaries, out of these.
void take_inner_curves(LoadedMesh& loaded) {
  std::vector<BoundaryEdges>& boundaries = loaded.mesh.boundaries;
  const auto first = std::ranges::find_if(boundaries, &BoundaryEdges::inner_line);
  for (auto line = first; line != boundaries.end(); ++line) {
    line->inner_line = false;
    loaded.inner_curves.push_back(std::move(*line));
  }
  boundaries.erase(first, boundaries.end());
}

NodeFlags flags_of(const LoadedMesh& loaded) {
  NodeFlags flags(loaded.mesh.owned_nodes, 0);
  for (const NodeId node : loaded.periodic_nodes) {
    if (loaded.mesh.owns(node)) flags[node] = 1;
  }
  return flags;
}

std::vector<NodeId> flagged_nodes(const std::vector<char>& flags) {
  std::vector<NodeId> nodes;
  for (std::int32_t i = 0; i < std::ssize(flags); ++i) {
    if (flags[i] != 0) nodes.emplace_back(i);
  }
  return nodes;
}

}  // namespace

LoadedMesh distributed(const Communicator& comm, LoadedMesh whole) {
  if (comm.size() == 1) return whole;
  const bool has_solution = comm.any(whole.solution.has_value()),
             has_periodic_nodes = comm.any(!whole.periodic_nodes.empty());
  const NodeFlags periodic = has_periodic_nodes ? flags_of(whole) : NodeFlags();
  list_inner_curves(whole);
  const MeshOrder order = comm.is_root() ? own_order(whole.mesh) : MeshOrder{};
  LoadedMesh part;
  part.mesh = scatter_mesh(comm, whole.mesh, order);
  take_inner_curves(part);
  part.blocks = static_cast<std::int32_t>(comm.maximum(std::int64_t{comm.is_root() ? whole.blocks : 0}));
  part.block_names = broadcast_words(comm, whole.block_names);
  part.triangle_to_block = scatter_triangles(comm, whole.triangle_to_block, order);
  part.quad_to_block = scatter_ordered(comm, std::span<const std::int32_t>(whole.quad_to_block), order.quads);
  part.warnings = broadcast_words(comm, whole.warnings);
  if (const auto names = broadcast_words(comm, whole.mesh.blocks.names); !names.empty())
    part.mesh.blocks = {names, part.triangle_to_block, part.quad_to_block};
  if (has_periodic_nodes) part.periodic_nodes = flagged_nodes(scatter_nodes(comm, periodic, order));
  whole.mesh = {};
  if (has_solution) part.solution = scatter_field(comm, whole.solution.value_or(Field{}), part.mesh, order);
  return part;
}

MeshOfFile distributed(const Communicator& comm, MeshOfFile whole) {
  const bool is_plane = std::holds_alternative<LoadedMesh>(whole);
  if (comm.any(comm.is_root() && !is_plane)) return comm.is_root() ? std::move(whole) : FileMesh{};
  return distributed(comm, std::get<LoadedMesh>(std::move(whole)));
}

LoadedMesh gathered(const Communicator& comm, const LoadedMesh& part) {
  if (comm.size() == 1) return part;
  LoadedMesh listed;
  listed.mesh = part.mesh;
  listed.inner_curves = part.inner_curves;
  list_inner_curves(listed);
  LoadedMesh whole;
  whole.mesh = gather_whole(comm, listed.mesh);
  take_inner_curves(whole);
  whole.blocks = part.blocks;
  whole.block_names = part.block_names;
  whole.triangle_to_block = gather_at_root(comm, part.triangle_to_block);
  whole.quad_to_block = gather_at_root(comm, part.quad_to_block);
  whole.warnings = part.warnings;
  whole.periodic_nodes = flagged_nodes(gather_at_root(comm, flags_of(part)));
  if (part.solution)
    whole.solution =
        gather_field(comm, *part.solution, part.mesh, comm.is_root() ? own_order(whole.mesh) : MeshOrder{});
  return whole;
}

}  // namespace quadloop::io
