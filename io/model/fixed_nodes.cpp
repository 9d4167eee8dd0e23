#include "io/model/fixed_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::io {

namespace {

std::string quoted(const std::vector<std::string>& names) {
  return fmt::format("'{}'", fmt::join(names, "', '"));
}

class Fixed {
 public:
  Fixed(const LoadedMesh& loaded, NodeFlags& flags) : loaded_{loaded}, flags_{flags} {}

  template <class Nodes>
  void fix(const Nodes& nodes) {
    flags_.resize(loaded_.mesh.points.size(), 0);
    for (const NodeId node : nodes) flags_[node] = 1;
  }
  void fix(GlobalNodeId node) {
    const std::int64_t own = node.value() - loaded_.mesh.first_node;
    const bool is_own = 0 <= own && own < loaded_.mesh.owned_nodes;
    fix(std::vector<NodeId>(is_own ? 1 : 0, NodeId{static_cast<std::int32_t>(own)}));
  }
  void fix(const BoundaryEdges& curve) {
    for (const auto& edge : curve.edges) fix(edge);
  }

  /// Returns whether anything has this name.
  bool fix_named(const std::string& name) {
    bool found = false;
    for (const auto* curves : {&loaded_.mesh.boundaries, &loaded_.inner_curves}) {
      for (const BoundaryEdges& curve : *curves) {
        if (curve.name != name) continue;
        fix(curve);
        found = true;
      }
    }
    for (std::int32_t block = 0; block < std::ssize(loaded_.block_names); ++block) {
      if (loaded_.block_names[block] != name) continue;
      for (const auto& cell : cells_of_block(loaded_.mesh.triangles, loaded_.triangle_to_block, block))
        fix(cell);
      for (const auto& cell : cells_of_block(loaded_.mesh.quads, loaded_.quad_to_block, block)) fix(cell);
      found = true;
    }
    return found;
  }

 private:
  const LoadedMesh& loaded_;
  NodeFlags& flags_;
};

std::vector<std::string> known_names(const LoadedMesh& loaded) {
  std::set<std::string> names(loaded.block_names.begin(), loaded.block_names.end());
  for (const auto* curves : {&loaded.mesh.boundaries, &loaded.inner_curves}) {
    for (const BoundaryEdges& curve : *curves) names.insert(curve.name);
  }
  return {names.begin(), names.end()};
}

/// Returns boundaries with an edge whose nodes are both periodic. *Collective.*
std::vector<std::string> periodic_boundaries(const Communicator& comm, const LoadedMesh& loaded,
                                             const NodeFlags& periodic) {
  const auto is_periodic = [&](const auto& edge) { return periodic[edge[0]] != 0 && periodic[edge[1]] != 0; };
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) {
    if (comm.any(std::ranges::any_of(boundary.edges, is_periodic))) names.push_back(boundary.name);
  }
  return names;
}

/// Sets the flags of a node on all ranks that have it if one of them has set it. *Collective.*
void agree(const Communicator& comm, const Mesh& mesh, NodeFlags& flags) {
  if (!comm.any(!flags.empty())) return;
  flags.resize(mesh.points.size(), 0);
  std::vector<GlobalNodeId> ghosts;
  for_each_flagged(flags, [&](NodeId node) {
    if (!mesh.owns(node)) ghosts.push_back(mesh.global(node));
  });
  const NodeOwners owners(comm, mesh.first_node);
  flag_at_owners(comm, owners, ghosts, flags);
  std::span<char> all(flags.data(), flags.size());
  NodeExchange(comm, owners, mesh.owned_nodes, mesh.ghosts).update(all);
}

}  // namespace

std::vector<std::string> fix_nodes(const Communicator& comm, const LoadedMesh& loaded,
                                   std::span<const std::string> names, const std::string& path,
                                   NodeFlags& flags) {
  Fixed fixed(loaded, flags);
  for (const std::string& name : names) {
    if (!fixed.fix_named(name))
      throw InputError(fmt::format("--fix: {} has no boundary, inner curve or block '{}', but {}", path, name,
                                   quoted(known_names(loaded))));
  }
  std::vector<std::string> notes;
  NodeFlags periodic;
  for (const NodeId node : loaded.periodic_nodes) {
    periodic.resize(loaded.mesh.points.size(), 0);
    periodic[node] = 1;
  }
  agree(comm, loaded.mesh, periodic);
  if (!periodic.empty()) {
    for_each_flagged(periodic, [&](NodeId node) { fixed.fix(std::array{node}); });
    notes.push_back(
        fmt::format("{}: the nodes of {} are fixed, because these sides are periodic or match node by node",
                    path, quoted(periodic_boundaries(comm, loaded, periodic))));
  }
  std::vector<std::string> names_of_nodes;
  for (const NamedNode& named : loaded.mesh.named_nodes) {
    fixed.fix(named.node);
    names_of_nodes.push_back(named.name);
  }
  if (!names_of_nodes.empty())
    notes.push_back(fmt::format("{}: the named nodes {} are fixed", path, quoted(names_of_nodes)));
  std::vector<std::string> curves;
  for (const BoundaryEdges& curve : loaded.inner_curves) {
    fixed.fix(curve);
    curves.push_back(curve.name);
  }
  if (!curves.empty())
    notes.push_back(fmt::format("{}: the nodes of the inner curves {} are fixed", path, quoted(curves)));
  agree(comm, loaded.mesh, flags);
  flags.resize(flags.empty() ? 0 : loaded.mesh.owned_nodes);
  return notes;
}

void separate_pairs(const Communicator& comm, LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  if (mesh.pairs.empty() || !comm.any(!loaded.periodic_nodes.empty())) return;
  NodeFlags of_pairs(mesh.points.size(), 0);
  std::vector<GlobalNodeId> ghosts;
  for (const NodeId node : nodes_on_sides(mesh)) {
    of_pairs[node] = 1;
    if (!mesh.owns(node)) ghosts.push_back(mesh.global(node));
  }
  flag_at_owners(comm, NodeOwners(comm, mesh.first_node), ghosts, of_pairs);
  std::erase_if(loaded.periodic_nodes, [&](NodeId node) { return of_pairs[node] != 0; });
}

}  // namespace quadloop::io
