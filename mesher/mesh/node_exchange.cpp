#include "mesher/mesh/node_exchange.hpp"

#include <algorithm>

namespace quadloop {

int NodeOwners::rank_of(GlobalNodeId node) const {
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), node.value()) - first_.begin()) - 1;
}

NodeExchange::NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
                           std::span<const GlobalNodeId> copies)
    : comm_{comm}, wanted_(static_cast<std::size_t>(comm.size())) {
  std::vector<std::vector<std::int32_t>> asked(wanted_.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const auto owner = static_cast<std::size_t>(owners.rank_of(copies[i]));
    wanted_[owner].push_back(owned_nodes + static_cast<std::int32_t>(i));
    asked[owner].push_back(owners.index_of(copies[i]));
  }
  shared_ = comm.exchange(asked);
}

}  // namespace quadloop
