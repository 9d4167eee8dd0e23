#include "mesher/mesh/node_exchange.hpp"

#include <algorithm>

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

int NodeOwners::rank_of(GlobalNodeId node) const {
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), node.value()) - first_.begin()) - 1;
}

NodeExchange::NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
                           std::span<const GlobalNodeId> copies)
    : CopyExchange(comm, listed(owners, owned_nodes, copies)) {}

}  // namespace quadloop
