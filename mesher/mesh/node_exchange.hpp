#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

/// Which rank owns a node: nodes are numbered over all ranks in the order of ranks.
class NodeOwners {
 public:
  /// `first_node` is the number of this rank's first owned node. *Collective.*
  NodeOwners(const Communicator& comm, std::int64_t first_node) : nodes_(comm, first_node) {}

  int rank_of(GlobalNodeId node) const { return nodes_.rank_of(node.value()); }
  /// On the rank that owns it.
  NodeId local(GlobalNodeId node) const {
    return NodeId{static_cast<std::int32_t>(node.value() - nodes_.begin(rank_of(node)))};
  }

 private:
  RankRanges nodes_;
};

/// Sets the flags of nodes on the ranks that own them; every rank may name any. *Collective.*
void flag_at_owners(const Communicator& comm, const NodeOwners& owners, std::span<const GlobalNodeId> nodes,
                    IdVector<NodeId, char>& flags);

/// Brings to each rank what the owners know of the nodes that it holds copies of: rows have one entry for
/// each owned node and each copy.
class NodeExchange : public CopyExchange {
 public:
  /// `copies` names the nodes after the owned ones, in the order of this rank's numbering. *Collective.*
  NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
               std::span<const GlobalNodeId> copies);
};

}  // namespace quadloop
