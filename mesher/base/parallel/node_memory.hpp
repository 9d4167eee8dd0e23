#pragma once

#include <cstddef>
#include <span>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/shared_array.hpp"

namespace quadloop {

/// Gives all ranks the arrays of the first rank. A node (a machine) with several ranks holds such an array
/// once, in memory that they share: a file without a name, so that a run that is killed leaves nothing
/// behind. If a rank of the node cannot map it, each of them has a copy.
class NodeMemory {
 public:
  /// With the nodes that MPI finds. *Collective.*
  explicit NodeMemory(const Communicator& comm);
  /// With nodes of ranks that give the same number; those of a node must be on one machine. *Collective.*
  NodeMemory(const Communicator& comm, int node);

  /// Returns the array of the first rank; those of other ranks are ignored. The result can be destroyed at
  /// any time, on any rank. *Collective.*
  template <class T>
  SharedArray<T> once_per_node(const SharedArray<T>& of_first) const {
    return bytes_once_per_node(of_first.template as<std::byte>()).template as<T>();
  }

 private:
  SharedArray<std::byte> bytes_once_per_node(const SharedArray<std::byte>& of_first) const;
  SharedArray<std::byte> shared_in_node(const SharedArray<std::byte>& of_first, std::size_t size) const;
  void receive(const SharedArray<std::byte>& of_first, std::span<std::byte> bytes) const;

  Communicator node_;    ///< the ranks of this node
  Communicator firsts_;  ///< on the first rank of a node: the first ranks of all nodes
};

}  // namespace quadloop
