#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop {

/// Which rank owns a node: nodes are numbered over all ranks in the order of ranks.
class NodeOwners {
 public:
  /// `first_node` is the number of this rank's first owned node. *Collective.*
  NodeOwners(const Communicator& comm, std::int64_t first_node) : first_{comm.all_gather(first_node)} {}

  int rank_of(GlobalNodeId node) const;
  std::int32_t index_of(GlobalNodeId node) const {
    return static_cast<std::int32_t>(node.value() - first_[static_cast<std::size_t>(rank_of(node))]);
  }

 private:
  std::vector<std::int64_t> first_;
};

/// Brings to each rank what the owners know of the nodes that it holds copies of.
class NodeExchange {
 public:
  /// `copies` names the nodes after the owned ones, in the order of this rank's numbering. *Collective.*
  NodeExchange(const Communicator& comm, const NodeOwners& owners, std::int32_t owned_nodes,
               std::span<const GlobalNodeId> copies);

  /// `values` has one entry for each owned node and each copy; those of the copies are replaced by their
  /// owners'. *Collective.*
  template <class T>
  void update(std::vector<T>& values) const {
    update(values, [](std::int32_t) { return true; });
  }
  /// The same for the owned nodes for which `changed` holds, alone. *Collective.*
  template <class T, class Changed>
  void update(std::vector<T>& values, const Changed& changed) const;

 private:
  const Communicator& comm_;
  std::vector<std::vector<std::int32_t>> wanted_;  ///< of each rank: this rank's copies of its nodes
  std::vector<std::vector<std::int32_t>>
      shared_;  ///< with each rank: owned nodes, in the order in which it wants them
};

template <class T, class Changed>
void NodeExchange::update(std::vector<T>& values, const Changed& changed) const {
  struct Item {
    std::int32_t place;
    T value;
  };
  if (comm_.size() == 1) return;
  std::vector<std::vector<Item>> out(shared_.size());
  for (std::size_t rank = 0; rank < shared_.size(); ++rank) {
    for (std::size_t i = 0; i < shared_[rank].size(); ++i) {
      const std::int32_t node = shared_[rank][i];
      if (changed(node))
        out[rank].push_back({static_cast<std::int32_t>(i), values[static_cast<std::size_t>(node)]});
    }
  }
  const auto received = comm_.exchange(out);
  for (std::size_t rank = 0; rank < received.size(); ++rank) {
    for (const Item& item : received[rank]) {
      values[static_cast<std::size_t>(wanted_[rank][static_cast<std::size_t>(item.place)])] = item.value;
    }
  }
}

}  // namespace quadloop
