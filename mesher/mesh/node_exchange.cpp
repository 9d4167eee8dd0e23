#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

std::vector<GhostExchange::Copy> listed(const NodeOwners& owners, std::int32_t owned_nodes,
                                        std::span<const GlobalNodeId> ghosts) {
  std::vector<GhostExchange::Copy> list;
  for (const GlobalNodeId node : ghosts)
    list.push_back({owned_nodes++, owners.rank_of(node), owners.local(node).value()});
  return list;
}

}  // namespace

void flag_at_owners(const Communicator& comm, const NodeOwners& owners, std::span<const GlobalNodeId> nodes,
                    IdVector<NodeId, char>& flags) {
  Outbox<GlobalNodeId> to_owners;
  for (const GlobalNodeId node : nodes) to_owners.add(owners.rank_of(node), node);
  for (const GlobalNodeId node : to_owners.deliver(comm)) flags[owners.local(node)] = 1;
}

NodeExchange::NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
                           std::span<const GlobalNodeId> ghosts)
    : GhostExchange(comm, listed(owners, owned_nodes, ghosts)) {}

}  // namespace quadloop
