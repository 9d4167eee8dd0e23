#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// A colouring of the nodes to be visited: neighbours differ, so all nodes of one colour can be visited
/// concurrently.
struct Colouring {
  /// For owned nodes and ghosts; `none` for those that are not visited.
  IdVector<NodeId, std::int8_t> colour_of;
  std::int8_t count = 0;  ///< over all ranks
  static constexpr std::int8_t none = -1;
};

/// Default for algorithms without prefetching.
struct NothingToFetch {
  void operator()(std::span<const std::int32_t> /*order*/, std::size_t /*k*/) const {}
};

/// Priority of a node: blocks of 2^`block_bits` node numbers in pseudo-random order, so that no long chain of
/// dependent nodes extends over many ranks; within a block the higher number comes first.
class ColouringPriority {
 public:
  ColouringPriority(GlobalNodeId node, int block_bits)
      : number_{static_cast<std::uint64_t>(node.value()) >> block_bits}, node_{node} {}
  std::uint64_t block() const { return mixed_bits(number_ + golden_step); }
  friend auto operator<=>(const ColouringPriority& a, const ColouringPriority& b) {
    return a.number_ == b.number_ ? a.node_ <=> b.node_ : a.block() <=> b.block();
  }

 private:
  std::uint64_t number_;  ///< of the block
  GlobalNodeId node_;
};

/// Returns the indices of `nodes`, which must be ascending, by descending priority.
inline std::vector<std::int32_t> order_of_choice(const HaloMesh& mesh, std::span<const NodeId> nodes,
                                                 int block_bits) {
  const auto priority = [&](std::size_t i) { return ColouringPriority(mesh.global(nodes[i]), block_bits); };
  std::vector<std::pair<std::uint64_t, std::int32_t>> blocks;  // with the index of the first node
  for (std::int32_t i = 0; i < std::ssize(nodes); ++i) {
    const std::uint64_t block = priority(i).block();
    if (blocks.empty() || blocks.back().first != block) blocks.emplace_back(block, i);
  }
  std::sort(blocks.begin(), blocks.end(), std::greater{});
  std::vector<std::int32_t> order;
  order.reserve(nodes.size());
  for (const auto& [block, first] : blocks) {
    std::int32_t end = first;
    while (end < std::ssize(nodes) && priority(end).block() == block) ++end;
    while (end > first) order.push_back(--end);
  }
  return order;
}

/// Greedy colouring: each node takes the first colour not used by a neighbour of higher priority.
template <class ForEachNeighbour>
class ColourChoices {
 public:
  /// Arguments as for colour_nodes(); they must outlive the object.
  ColourChoices(const HaloMesh& mesh, std::span<const NodeId> nodes,
                const ForEachNeighbour& for_each_neighbour, int block_bits)
      : mesh_{mesh},
        nodes_{nodes},
        for_each_neighbour_{for_each_neighbour},
        block_bits_{block_bits},
        colours_(mesh.points().size(), Colouring::none) {
    for (const NodeId node : nodes) colours_[node] = waiting;
  }

  /// Colours the i-th node unless a neighbour of higher priority is uncoloured. Returns whether it is
  /// coloured.
  bool choose(std::size_t i) {
    std::uint64_t taken = 0;
    bool may_wait = false;
    for_each_neighbour_(i, [&](NodeId other) {  // branch-free, as colours are unpredictable
      const std::int8_t colour = colours_[other];
      // a coloured neighbour of this round had priority
      taken |= std::uint64_t{colour >= 0} << (colour & 63);
      may_wait = may_wait | (colour == passed_over) | !mesh_.owns(other);
    });
    const bool waits = may_wait && must_wait(i);
    QUADLOOP_REQUIRE(~taken != 0, "a node has fewer than 64 neighbours of different colours");
    colours_[nodes_[i]] = waits ? passed_over : static_cast<std::int8_t>(std::countr_one(taken));
    return !waits;
  }
  /// *Collective.*
  void share() { mesh_.exchange().update(colours_); }
  /// Call after all nodes are coloured. *Collective.*
  Colouring colouring(const Communicator& comm) {
    std::int8_t largest = Colouring::none;
    for (const NodeId node : nodes_) largest = std::max(largest, colours_[node]);
    const std::int64_t last = comm.maximum(std::int64_t{largest});
    return {std::move(colours_), static_cast<std::int8_t>(last + 1)};
  }

 private:
  static constexpr std::int8_t waiting = -2, passed_over = -3;
  ColouringPriority priority(NodeId node) const { return {mesh_.global(node), block_bits_}; }
  bool must_wait(std::size_t i) const {
    const ColouringPriority own = priority(nodes_[i]);
    bool must = false;
    // uncoloured nodes of this rank that have not been passed over come later
    for_each_neighbour_(i, [&](NodeId other) {
      const std::int8_t colour = colours_[other];
      const bool undecided = colour == passed_over || (colour == waiting && !mesh_.owns(other));
      must = must || (undecided && priority(other) > own);
    });
    return must;
  }

  const HaloMesh& mesh_;
  std::span<const NodeId> nodes_;
  const ForEachNeighbour& for_each_neighbour_;
  int block_bits_;
  IdVector<NodeId, std::int8_t> colours_;
};

/// Greedy colouring in an order that depends only on global node numbers: each node takes the first colour
/// not used by a neighbour of higher priority (Jones and Plassmann 1993). `nodes` are the owned nodes to be
/// visited, ascending; for_each_neighbour(i, visit) calls visit with the neighbours of the i-th of them,
/// possibly with itself and with repetitions. `block_bits` as in ColouringPriority: above 0, nearby nodes are
/// coloured one after another, which is faster. `fetch_ahead(order, k)` is called before the neighbours of
/// nodes[order[k]] are requested. *Collective.*
template <class ForEachNeighbour, class FetchAhead = NothingToFetch>
Colouring colour_nodes(const Communicator& comm, const HaloMesh& mesh, std::span<const NodeId> nodes,
                       const ForEachNeighbour& for_each_neighbour, int block_bits = 0,
                       const FetchAhead& fetch_ahead = {}) {
  ColourChoices choices(mesh, nodes, for_each_neighbour, block_bits);
  std::vector<std::int32_t> order = order_of_choice(mesh, nodes, block_bits);  // uncoloured nodes
  choices.share();
  do {
    std::size_t still_waiting = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      fetch_ahead(order, k);
      if (!choices.choose(order[k])) order[still_waiting++] = order[k];
    }
    order.resize(still_waiting);
    choices.share();
  } while (comm.any(!order.empty()));
  return choices.colouring(comm);
}

}  // namespace quadloop
