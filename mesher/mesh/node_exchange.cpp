#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

std::vector<CopyExchange::Copy> listed(const NodeOwners& owners, std::int32_t owned_nodes,
                                       std::span<const GlobalNodeId> copies) {
  std::vector<CopyExchange::Copy> list;
  for (const GlobalNodeId node : copies)
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
                           std::span<const GlobalNodeId> copies)
    : CopyExchange(comm, listed(owners, owned_nodes, copies)) {}

}  // namespace quadloop
