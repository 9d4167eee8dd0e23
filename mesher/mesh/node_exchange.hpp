#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

/// Owner ranks of nodes; global node numbers follow the order of ranks.
class NodeOwners {
 public:
  /// `first_node` is the global number of this rank's first owned node. *Collective.*
  NodeOwners(const Communicator& comm, std::int64_t first_node) : nodes_(comm, first_node) {}

  int rank_of(GlobalNodeId node) const { return nodes_.rank_of(node.value()); }
  /// Local number on the owner rank.
  NodeId local(GlobalNodeId node) const {
    return NodeId{static_cast<std::int32_t>(node.value() - nodes_.begin(rank_of(node)))};
  }

 private:
  RankRanges nodes_;
};

/// Sets the flags of nodes on their owners; every rank may name any node. *Collective.*
void flag_at_owners(const Communicator& comm, const NodeOwners& owners, std::span<const GlobalNodeId> nodes,
                    IdVector<NodeId, char>& flags);

/// Copies nodal values from the owners to the ghosts. Arrays have one row for each owned node, then one for
/// each ghost.
class NodeExchange : public GhostExchange {
 public:
  /// `ghosts` are the global numbers of the ghosts, in this rank's order. *Collective.*
  NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
               std::span<const GlobalNodeId> ghosts);
};

}  // namespace quadloop
