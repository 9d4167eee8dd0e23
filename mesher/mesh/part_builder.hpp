#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

/// Builds a rank's part of a mesh from its nodes, and from cells and edges with global node numbers.
class PartBuilder {
 public:
  /// `points` are this rank's nodes, which follow those of lower ranks. *Collective.*
  PartBuilder(const Communicator& comm, std::vector<Point> points)
      : part_{part_of(comm, std::move(points))}, nodes_{part_} {}

  Mesh& part() { return part_; }

  /// Returns the node's number on this rank; one of another rank becomes a ghost.
  NodeId local(GlobalNodeId node) { return nodes_.local(node, {}); }
  template <std::size_t width>
  std::array<NodeId, width> local(const std::array<GlobalNodeId, width>& nodes) {
    std::array<NodeId, width> numbers;
    for (std::size_t k = 0; k < width; ++k) numbers[k] = local(nodes[k]);
    return numbers;
  }
  /// Appends cells or edges.
  template <std::size_t width>
  void append(std::span<const std::array<GlobalNodeId, width>> rows,
              std::vector<std::array<NodeId, width>>& to) {
    for (const auto& row : rows) to.push_back(local(row));
  }

  /// Fetches the positions of the ghosts. *Collective.*
  Mesh finish(const Communicator& comm) {
    const NodeOwners owners(comm, part_.first_node);
    NodeExchange(comm, owners, part_.owned_nodes, part_.ghosts).update(part_.points);
    return std::move(part_);
  }

 private:
  static Mesh part_of(const Communicator& comm, std::vector<Point> points) {
    Mesh part;
    part.points = std::move(points);
    part.owned_nodes = size32(part.points);
    part.first_node = comm.exclusive_sum(part.owned_nodes);
    return part;
  }

  Mesh part_;
  NodeTable nodes_;
};

}  // namespace quadloop
