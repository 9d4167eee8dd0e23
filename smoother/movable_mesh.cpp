#include "smoother/movable_mesh.hpp"

#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::smoother {

namespace {

/// Appends the nodes of a cell that has another image of the same node: a cell that reaches from one side of
/// a pair to the other.
template <class Nodes>
void append_repeated(const Mesh& mesh, const Nodes& cell, std::vector<GlobalNodeId>& repeated) {
  for (std::size_t i = 0; i < cell.size(); ++i) {
    for (std::size_t k = i + 1; k < cell.size(); ++k) {
      const GlobalNodeId node = original_of(mesh.global(cell[i]));
      if (node == original_of(mesh.global(cell[k]))) repeated.push_back(node);
    }
  }
}

}  // namespace

MovableMesh::MovableMesh(const Communicator& comm, Mesh& mesh, const NodeFlags& pinned)
    : comm_{comm},
      given_{mesh},
      joined_{join_pairs_if_possible(comm, mesh, SideEdges::kept)},
      pinned_{joined_ ? pinned_in(pinned) : pinned_on_sides(pinned)},
      halo_{joined_ ? HaloMesh(comm, *joined_) : HaloMesh(comm, mesh)} {
  if (joined_) taken_ = halo_.points();
}

NodeFlags MovableMesh::pinned_in(const NodeFlags& given) const {
  const Mesh& mesh = joined_->mesh;
  std::vector<GlobalNodeId> stay;
  for_each_flagged(given,
                   [&](NodeId node) { stay.push_back(original_of(mesh.global(joined_->node_of[node]))); });
  mesh.for_each_cell([&](const auto& cell) { append_repeated(mesh, cell, stay); });
  NodeFlags pinned(mesh.owned_nodes, 0);
  flag_at_owners(comm_, NodeOwners(comm_, mesh.first_node), stay, pinned);
  return pinned;
}

NodeFlags MovableMesh::pinned_on_sides(NodeFlags pinned) const {
  if (given_.pairs.empty()) return pinned;
  std::vector<GlobalNodeId> stay;
  for (const NodeId node : nodes_on_sides(given_)) stay.push_back(given_.global(node));
  pinned.resize(given_.owned_nodes, 0);
  flag_at_owners(comm_, NodeOwners(comm_, given_.first_node), stay, pinned);
  return pinned;
}

NodeFlags MovableMesh::take_positions() {
  NodeFlags moved(given_.points.size(), 0);
  const auto take = [&](NodeId node, NodeId from) {
    given_.points[node.value()] = halo_.point(from);
    moved[node] = 1;
  };
  if (!joined_) {
    for (const NodeId node : moved.ids()) {
      if (given_.point(node) != halo_.point(node)) take(node, node);
    }
    return moved;
  }
  for (const NodeId node : joined_->node_of.ids()) {
    const NodeId from = joined_->node_of[node];
    if (taken_[from.value()] != halo_.point(from)) take(node, from);
  }
  taken_ = halo_.points();
  const NodeExchange exchange = exchange_of_given();
  exchange.update(given_.points);
  exchange.update(moved);
  return moved;
}

NodeFlags MovableMesh::in_given(NodeFlags flags) const {
  if (!joined_) return flags;
  flags.resize(halo_.points().size(), 0);
  NodeFlags given(given_.points.size(), 0);
  for (const NodeId node : joined_->node_of.ids()) given[node] = flags[joined_->node_of[node]];
  exchange_of_given().update(given);
  return given;
}

NodeExchange MovableMesh::exchange_of_given() const {
  return {comm_, NodeOwners(comm_, given_.first_node), given_.owned_nodes, given_.ghosts};
}

}  // namespace quadloop::smoother
